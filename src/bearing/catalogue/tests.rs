//! The table against itself and against other publications.

use super::{CatalogueBearing, GROOVES, OuterRingSection, Source, normal_clearance};

const STEEL: f64 = 7850.0;

fn named(name: &str) -> &'static CatalogueBearing {
    CatalogueBearing::named(name).unwrap_or_else(|| panic!("{name}"))
}

#[test]
fn every_bearing_is_one_that_can_be_built() {
    for bearing in CatalogueBearing::all() {
        let name = bearing.name;
        let (race, inner) = (bearing.outer_race_diameter(), bearing.inner_race_diameter());
        // the rings have material at the grooves' bottoms; 607 has the balls of 626 and a thinner inner ring
        assert!(inner > bearing.bore + 0.8e-3 && race < bearing.outer_diameter - 1e-3, "{name}");
        // balls fit, with room for a cage
        let pitch = bearing.pitch_diameter * (std::f64::consts::PI / f64::from(bearing.balls)).sin();
        assert!(pitch > 1.05 * bearing.ball_diameter, "{name}");
        assert!(bearing.ball_diameter < 0.9 * bearing.width, "{name}");
        // the shoulders lie between the balls' centres and the groove's bottom
        if let Some(shoulder) = bearing.shoulder_diameter {
            assert!(shoulder > bearing.pitch_diameter && shoulder < race, "{name}");
        }
        // a bearing is steel and air
        let around = bearing.outer_diameter.powi(2) - bearing.bore.powi(2);
        let full = STEEL * 0.25 * std::f64::consts::PI * around * bearing.width;
        let filled = bearing.mass / full;
        assert!((0.55..1.0).contains(&filled), "{name}: {filled}");
    }
}

/// Basic dynamic radial load rating (N) of a bearing by ISO 281:2007, 5.1, `C_r = 1.3 f_c Z^(2/3) D_w^1.8`, with f_c by the formula of
/// ISO/TR 8646 for the grooves of 0.52 and 0.53.
fn rating(bearing: &CatalogueBearing) -> f64 {
    let gamma = bearing.ball_diameter / bearing.pitch_diameter;
    let [inner, outer] = GROOVES;
    let ratio = inner * (2.0 * outer - 1.0) / (outer * (2.0 * inner - 1.0));
    let races = 1.04 * ((1.0 - gamma) / (1.0 + gamma)).powf(1.72) * ratio.powf(0.41);
    let curvature = gamma.powf(0.3) * (1.0 - gamma).powf(1.39) / (1.0 + gamma).cbrt();
    let inner_groove = (2.0 * inner / (2.0 * inner - 1.0)).powf(0.41);
    let factor = 39.9 * 0.95 * (1.0 + races.powf(10.0 / 3.0)).powf(-0.3) * curvature * inner_groove;
    1.3 * factor * f64::from(bearing.balls).powf(2.0 / 3.0) * (1e3 * bearing.ball_diameter).powf(1.8)
}

/// Ratings that NSK publishes for bearings of the same names (Rolling bearings, CAT. No. E1102, pp. B8 to B13), of 6200 SKF's, since NSK's has
/// smaller balls. A ball fewer or of the next size changes the rating by 9 % or more: 15 % leaves room for another maker's balls.
#[test]
fn load_ratings_are_near_published_ones() {
    let published = [
        ("608", 3300.0),
        ("629", 4550.0),
        ("6000", 4550.0),
        ("6001", 5100.0),
        ("6002", 5600.0),
        ("6003", 6000.0),
        ("6004", 9400.0),
        ("6005", 10_100.0),
        ("6006", 13_200.0),
        ("6007", 16_000.0),
        ("6008", 16_800.0),
        ("6009", 20_900.0),
        ("6010", 21_800.0),
        ("6200", 5400.0),
        ("6201", 6800.0),
        ("6202", 7650.0),
        ("6203", 9550.0),
        ("6204", 12_800.0),
        ("6205", 14_000.0),
        ("6206", 19_500.0),
        ("6207", 25_700.0),
        ("6208", 29_100.0),
        ("6209", 31_500.0),
        ("6210", 35_000.0),
        ("6305", 20_600.0),
        ("6306", 26_700.0),
        ("6307", 33_500.0),
        ("6308", 40_500.0),
        ("6309", 53_000.0),
        ("6310", 62_000.0),
    ];
    for (name, expected) in published {
        let off = rating(named(name)) / expected - 1.0;
        assert!(off.abs() < 0.15, "{name}: {off}");
    }
}

#[test]
fn bores_follow_from_the_names() {
    for bearing in CatalogueBearing::all().iter().filter(|b| b.name.len() == 4) {
        let code: f64 = bearing.name[2..].parse().unwrap();
        let bore = match code as u32 {
            0 => 10.0,
            1 => 12.0,
            2 => 15.0,
            3 => 17.0,
            _ => 5.0 * code,
        };
        assert!((1e3 * bearing.bore - bore).abs() < 1e-9, "{}", bearing.name);
    }
}

/// Smith and Randall (2015), table 1 (Case Western Reserve's bearings): 6205 with 9 balls has the orders 3.585, 5.415 and 0.3983;
/// 6203 with 8 balls 3.053, 4.947 and 0.3816.
#[test]
fn orders_are_those_of_published_measurements() {
    for (name, outer, inner, cage) in [("6205", 3.585, 5.415, 0.3983), ("6203", 3.053, 4.947, 0.3816)] {
        let bearing = named(name);
        let (balls, ratio) = (f64::from(bearing.balls), bearing.ball_diameter / bearing.pitch_diameter);
        let orders = [0.5 * balls * (1.0 - ratio), 0.5 * balls * (1.0 + ratio), 0.5 * (1.0 - ratio)];
        for (found, expected) in orders.into_iter().zip([outer, inner, cage]) {
            // pitch diameters of 39.1 and 39.04 mm differ by 1.5e-3, which the orders feel by a fifth
            assert!((found / expected - 1.0).abs() < 5e-4, "{name}: {found} {expected}");
        }
    }
}

/// What stands for the pitch diameter where none is published, against those that are, in the series it is used for and beside.
#[test]
fn the_mean_of_bore_and_outer_diameter_is_near_the_pitch_diameter() {
    for bearing in CatalogueBearing::all() {
        let mean = 0.5 * (bearing.bore + bearing.outer_diameter);
        let off = (mean / bearing.pitch_diameter - 1.0).abs();
        if bearing.pitch_published && bearing.name.len() == 4 {
            assert!(off < 0.02, "{}: {off}", bearing.name);
        } else if !bearing.pitch_published {
            assert!(off < 1e-12, "{}", bearing.name);
        }
    }
}

#[test]
fn names_are_found_with_suffixes_and_once() {
    for bearing in CatalogueBearing::all() {
        assert_eq!(CatalogueBearing::named(bearing.name), Some(bearing));
        let twice = CatalogueBearing::all().iter().filter(|b| b.name == bearing.name);
        assert_eq!(twice.count(), 1);
    }
    for name in [" 6205 ", "6205-2RS", "6205 2Z", "6205/C3"] {
        assert_eq!(CatalogueBearing::named(name), Some(named("6205")), "{name}");
    }
    for name in ["", "620", "62055", "SKF 6205", "6205.toml", "./6205"] {
        assert_eq!(CatalogueBearing::named(name), None, "{name}");
    }
    for source in Source::ALL {
        assert!(source.citation().contains(source.name()));
    }
}

#[test]
fn the_nearest_are_all_of_one_outer_diameter() {
    let names = |diameter: f64| -> Vec<&str> {
        let near = CatalogueBearing::nearest(diameter);
        near.into_iter().map(|(bearing, _)| bearing.name).collect()
    };
    assert_eq!(names(52e-3), ["6205"]);
    assert_eq!(names(51.9e-3), ["6205"]);
    assert_eq!(names(62e-3), ["6007", "6206", "6305"]);
    let (_, off) = CatalogueBearing::nearest(12e-3)[0];
    assert!((off - 1.0 / 3.0).abs() < 1e-12, "{off}");
    for nothing in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(names(nothing).is_empty());
    }
}

#[test]
fn clearances_are_those_of_the_row() {
    for (bore, expected) in [
        (5e-3, Some([2e-6, 13e-6])),
        (10e-3, Some([2e-6, 13e-6])),
        (12e-3, Some([3e-6, 18e-6])),
        (25e-3, Some([5e-6, 20e-6])),
        (50e-3, Some([6e-6, 23e-6])),
        (1e-3, None),
        (51e-3, None),
        (f64::NAN, None),
    ] {
        let found = normal_clearance(bore);
        let near = match (found, expected) {
            (Some(found), Some(expected)) => found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12),
            (None, None) => true,
            _ => false,
        };
        assert!(near, "{bore}: {found:?}");
    }
    assert!(CatalogueBearing::all().iter().all(|b| normal_clearance(b.bore).is_some()));
}

/// Against strips of the section across the radius, added up.
#[test]
fn the_section_is_the_rectangle_less_the_groove() {
    let bearing = named("6205");
    let section = OuterRingSection::of(bearing);
    let (outer, shoulder) = (0.5 * bearing.outer_diameter, 0.5 * bearing.shoulder_diameter.unwrap());
    let groove = GROOVES[1] * bearing.ball_diameter;
    let centre = 0.5 * bearing.outer_race_diameter() - groove;
    let strips = 200_000;
    let step = (outer - shoulder) / f64::from(strips);
    let [mut area, mut first, mut second, mut axial] = [0.0; 4];
    for strip in 0..strips {
        let radius = shoulder + (f64::from(strip) + 0.5) * step;
        let open = 2.0 * (groove.powi(2) - (radius - centre).powi(2)).max(0.0).sqrt();
        let width = bearing.width - open;
        area += width * step;
        first += width * radius * step;
        second += width * radius.powi(2) * step;
        axial += (bearing.width.powi(3) - open.powi(3)) / 12.0 * step;
    }
    let radius = first / area;
    for (found, expected) in [
        (section.area, area),
        (section.radius, radius),
        (section.inertia, second - area * radius.powi(2)),
        (section.axial_inertia, axial),
    ] {
        // strips miss the groove's vertical tangent by less than this; the inertia is a difference of numbers 400 times larger
        assert!((found / expected - 1.0).abs() < 1e-5, "{found} {expected}");
    }
    // an outer ring is about half of its bearing
    for bearing in CatalogueBearing::all() {
        let section = OuterRingSection::of(bearing);
        let mass = STEEL * section.area * std::f64::consts::TAU * section.radius;
        let share = mass / bearing.mass;
        assert!((0.25..0.65).contains(&share), "{}: {share}", bearing.name);
        assert!(section.inertia > 0.0 && section.axial_inertia > section.inertia, "{}", bearing.name);
    }
}
