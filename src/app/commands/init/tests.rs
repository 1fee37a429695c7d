//! What is made of the numbers behind a case file.

use super::pit::Pit;
use super::scene::{BALANCE, BearingNumbers, RingNumbers, SPEED_HZ};
use super::scene::{UnitFrom, unit_of};
use super::shaft::ShaftNumbers;
use std::path::Path;

use super::bore::spot;
use super::groups::{Groups, SupportGuess};
use crate::bearing::catalogue::{CatalogueBearing, OuterRingSection};
use crate::fe::mesh::{DeckMaterial, Mesh, Rim};
use crate::numerics::units::LengthUnit;

fn named(name: &str) -> &'static CatalogueBearing {
    CatalogueBearing::named(name).unwrap_or_else(|| panic!("{name}"))
}

#[test]
fn a_unit_is_given_told_by_the_bearing_or_guessed() {
    let bearing = Some(named("6205"));
    for (given, longest, radius, bearing, expected) in [
        (Some(LengthUnit::Inch), 44.0, Some(26.0), bearing, (LengthUnit::Inch, UnitFrom::Given)),
        (None, 44.0, Some(26.0), bearing, (LengthUnit::Millimetre, UnitFrom::Bearing)),
        (None, 4.4, Some(26.1 / 25.4), bearing, (LengthUnit::Inch, UnitFrom::Bearing)),
        (None, 4.4, Some(1.0), bearing, (LengthUnit::Millimetre, UnitFrom::Extent)),
        (None, 44.0, Some(26.0), None, (LengthUnit::Millimetre, UnitFrom::Extent)),
        (None, 0.044, None, None, (LengthUnit::Metre, UnitFrom::Extent)),
    ] {
        assert_eq!(unit_of(given, longest, radius, bearing, None), expected, "{longest} {radius:?}");
    }
}

/// The ring of the source paper's bearing of 12 mm (Table 1 and docs/paper.md: area 5.37e-6 m^2, second moment 8.88e-13 m^4,
/// radius 5.314 mm) against that of 625 scaled to 12 mm: another bearing, of the same kind.
#[test]
fn a_scaled_ring_is_like_that_of_a_bearing_of_this_size() {
    let found = RingNumbers::of(named("625"), 12e-3);
    assert!((found.scale - 0.75).abs() < 1e-12);
    let section = found.section;
    for (found, expected, within) in
        [(section.area, 5.37e-6, 0.2), (section.inertia, 8.88e-13, 0.5), (section.radius, 5.314e-3, 0.03)]
    {
        assert!((found / expected - 1.0).abs() < within, "{found} {expected}");
    }
    // as a solid body grows: twice as large, four times the area, 16 times the second moment
    let twice = RingNumbers::of(named("625"), 24e-3).section;
    assert!((twice.area / section.area - 4.0).abs() < 1e-9);
    assert!((twice.inertia / section.inertia - 16.0).abs() < 1e-9);
    assert!((twice.axial_inertia / section.axial_inertia - 16.0).abs() < 1e-9);
    let own = RingNumbers::of(named("6205"), 52e-3);
    let whole = OuterRingSection::of(named("6205"));
    for (found, expected) in [
        (own.section.area, whole.area),
        (own.section.radius, whole.radius),
        (own.section.inertia, whole.inertia),
        (own.section.axial_inertia, whole.axial_inertia),
    ] {
        // 52 mm over 52 mm is one but for rounding
        assert!((found / expected - 1.0).abs() < 1e-12);
    }
}

#[test]
fn numbers_of_6205() {
    let numbers = BearingNumbers::of(named("6205"));
    // clearance of 5 to 20 um: 12.5 um in the middle, half of it to either side
    assert!((numbers.usual.play - 6.25e-6).abs() < 1e-12);
    assert!((numbers.usual.inner_groove - 0.52 * 7.938e-3).abs() < 1e-12);
    assert!((numbers.usual.outer_groove - 0.53 * 7.938e-3).abs() < 1e-12);
    let ShaftNumbers { mass, unbalance, .. } = ShaftNumbers::cylinder(25e-3, 250e-3, 0.0);
    // a bar of 25 mm and 250 mm: 0.963 kg; 6.3 mm/s at 25 Hz: 40.1 um
    assert!((mass - 0.9633).abs() < 1e-3, "{mass}");
    assert!((unbalance / (mass * 40.107e-6) - 1.0).abs() < 1e-4, "{unbalance}");
    assert!((BALANCE / SPEED_HZ - 2.52e-4).abs() < 1e-12);
}

/// A ball bridges the pit and drops less far than into a groove, whichever bearing of the catalogue has it, scaled or not.
#[test]
fn a_ball_drops_into_every_pit_and_no_farther_than_its_depth() {
    for bearing in CatalogueBearing::all() {
        for scale in [0.5, 1.0, 2.0] {
            let pit = Pit::of(&BearingNumbers::of(bearing), scale);
            let [surface, plane] = pit.drops.unwrap_or_else(|| panic!("{}", bearing.name));
            assert!(0.0 < surface && surface < plane, "{}: {surface} {plane}", bearing.name);
            assert!((pit.first_ball_deg - 270.0 - 180.0 / f64::from(bearing.balls)).abs() < 1e-9);
        }
    }
    // measured by a run of 6204 with this pit
    let [surface, plane] = Pit::of(&BearingNumbers::of(named("6204")), 1.0).drops.unwrap();
    assert!((surface - 20.65e-6).abs() < 0.5e-6 && (plane - 32e-6).abs() < 0.5e-6, "{surface} {plane}");
}

/// Two squares side by side, nodes 1 to 6; the groups after them are each test's own.
fn squares(names: &str, elements: &[&str]) -> Mesh {
    let text = format!(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n{}\n{names}$EndPhysicalNames\n\
         $Nodes\n6\n1 0 0 0\n2 1 0 0\n3 2 0 0\n4 0 1 0\n5 1 1 0\n6 2 1 0\n$EndNodes\n$Elements\n{}\n{}\n$EndElements\n",
        names.lines().count(),
        elements.len(),
        elements.join("\n")
    );
    Mesh::from_gmsh_bytes(text.as_bytes(), Path::new("squares.msh"), LengthUnit::Metre).unwrap()
}

/// The notes of the groups that are not used.
fn notes(groups: &Groups) -> Vec<(&str, &str)> {
    let others = groups.others.iter();
    let noted = others.map(|other| (other.group.as_str(), other.note.unwrap_or_default()));
    noted.map(|(name, note)| (name, note.split([':', ',']).next().unwrap_or_default())).collect()
}

fn held(groups: &Groups) -> Vec<&str> {
    groups.supports.iter().map(|support| support.group.as_str()).collect()
}

#[test]
fn a_sensor_stands_where_nothing_is_held() {
    let names = "2 1 \"steel\"\n1 3 \"foot\"\n";
    let mesh = squares(names, &["1 3 2 1 1 1 2 5 4", "2 3 2 1 1 2 3 6 5", "3 1 2 3 3 4 5"]);
    let rim = Rim::of(&mesh, 2);
    let place = |held: &[SupportGuess]| {
        let found = spot(&mesh, &rim, [0.0; 3], 0.0, [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], held).unwrap();
        mesh.nodes.iter().position(|node| node.map(f64::to_bits) == found.map(f64::to_bits)).unwrap() + 1
    };
    let groups = Groups::of(&mesh, 2, &[]);
    assert_eq!(held(&groups), ["foot"]);
    assert_eq!((place(&[]), place(&groups.supports)), (4, 6));
}

#[test]
fn groups_are_parts_supports_and_sensors_by_dimension_and_name() {
    let names =
        "2 1 \"steel half\"\n2 2 \"rest\"\n1 3 \"Feet\"\n1 4 \"seat\"\n1 5 \"rim\"\n0 6 \"top\"\n1 7 \"base\"\n";
    let mesh = squares(
        names,
        &[
            "1 3 2 1 1 1 2 5 4",
            "2 3 2 2 2 2 3 6 5",
            "3 1 2 3 3 1 2",
            "4 1 2 4 4 5 6",
            "5 1 2 5 5 3 6",
            "6 15 2 6 6 4",
            "7 1 2 7 7 4 5",
        ],
    );
    let groups = Groups::of(&mesh, 2, &["seat"]);
    let parts: Vec<(&str, &str, &str)> =
        groups.parts.iter().map(|part| (part.group.as_str(), part.material.as_str(), part.from)).collect();
    assert_eq!(parts, [("steel half", "steel", "by its name"), ("rest", "aluminium", "guess")]);
    assert_eq!(held(&groups), ["Feet"]);
    assert_eq!(groups.sensor.as_deref(), Some("top"));
    assert_eq!(groups.without_part, 0);
    // node 5 is the seat's too, and what is tied cannot be fixed
    assert_eq!(notes(&groups), [("rim", "shares nodes with the bore"), ("base", "looks like a support")]);
    // without a ring it can
    assert_eq!(held(&Groups::of(&mesh, 2, &[])), ["Feet", "base"]);
}

#[test]
fn groups_that_overlap_share_a_name_or_hang_in_the_air_are_left() {
    let names = "2 1 \"all\"\n2 2 \"half\"\n1 3 \"twice\"\n1 4 \"twice\"\n";
    let mesh = squares(
        names,
        &["1 3 2 1 1 1 2 5 4", "2 3 2 1 1 2 3 6 5", "3 3 2 2 1 1 2 5 4", "4 1 2 3 3 1 2", "5 1 2 4 4 2 3"],
    );
    let groups = Groups::of(&mesh, 2, &[]);
    assert_eq!(groups.parts.len(), 1);
    assert_eq!(groups.parts[0].group, "all");
    assert_eq!(groups.supports.len(), 0);
    let noted = notes(&groups);
    let shared = ("half", "shares elements with a part");
    assert!(noted.contains(&shared), "{noted:?}");
    let twice = ("twice", "another group has this name too");
    assert_eq!(noted.iter().filter(|note| **note == twice).count(), 2);
    // the right half in no group at all, and the base under it
    let names = "2 1 \"left\"\n1 3 \"base\"\n";
    let mesh = squares(names, &["1 3 2 1 1 1 2 5 4", "2 3 2 0 2 2 3 6 5", "3 1 2 3 3 2 3"]);
    let groups = Groups::of(&mesh, 2, &[]);
    assert_eq!((groups.parts.len(), groups.without_part), (1, 1));
    assert_eq!(groups.supports.len(), 0);
    assert_eq!(notes(&groups), [("base", "looks like a support")]);
}

/// Lines that cannot be used name a group all the same.
#[test]
fn what_a_boundary_names_is_not_guessed() {
    let deck = "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n*ELEMENT,TYPE=C3D4,ELSET=body\n1,1,2,3,4\n*ELSET,ELSET=part\n1\n\
        *NSET,NSET=fix\n1,2,3\n*NSET,NSET=base\n1,2,4\n*TRANSFORM,NSET=fix\n0,1,0,1,0,0\n*BOUNDARY\nfix,1\n";
    let of = |deck: &str| {
        let mesh = Mesh::from_bytes(deck.as_bytes(), Path::new("a.inp"), LengthUnit::Metre).unwrap();
        let mut groups = Groups::of(&mesh, 3, &[]);
        groups.hold_flat(&["fix".to_owned(), "base".to_owned()], 3);
        groups
    };
    let groups = of(deck);
    assert_eq!(held(&groups), [""; 0], "{groups:?}");
    assert!(notes(&groups).contains(&("fix", "*BOUNDARY of the file names it")), "{groups:?}");
    assert_eq!(held(&of(&deck.replace("fix,1", "fix,1,3"))), ["fix"]);
    assert_eq!(held(&of(deck.split("*TRANSFORM").next().unwrap())), ["fix", "base"]);
}

#[test]
fn what_a_material_of_the_file_lacks_is_said_as_such() {
    let of = |elastic, density, law: Option<&str>| {
        let name = "m".to_owned();
        let other_law = law.map(str::to_owned);
        super::text::lacks(&DeckMaterial { name, elastic, density, other_law, ..DeckMaterial::default() })
    };
    let own = |elastic, density| of(elastic, density, None);
    assert_eq!(own(Some([1.0, 0.499_999_999_999_9]), Some(1.0)), None);
    for (said, expected) in [
        (own(None, Some(1.0)), "it has no isotropic *ELASTIC"),
        (own(Some([1.0, 0.3]), None), "it has no *DENSITY"),
        (own(Some([1.0, 0.5]), Some(1.0)), "its Poisson's ratio is 0.5, expected more than -1 and less than 0.5"),
        (own(Some([1.0, -1.0]), Some(1.0)), "its Poisson's ratio is -1, expected more than -1 and less than 0.5"),
        (own(Some([1.0, 0.3]), Some(0.0)), "its density is 0, expected more than 0"),
        (own(Some([0.0, 0.3]), Some(1.0)), "its modulus is 0, expected more than 0"),
        (
            of(None, None, Some("*ELASTIC, TYPE=ORTHO")),
            "it has *ELASTIC, TYPE=ORTHO. Write [materials.\"m\"] by hand: young of x, y, z; poisson and shear of xy, yz, xz; x_axis and y_axis of its *ORIENTATION",
        ),
        (
            of(None, None, Some("*HYPERFOAM")),
            "it has *HYPERFOAM, and a case has linear materials. Write young and poisson of small strains by hand",
        ),
    ] {
        assert_eq!(said.as_deref(), Some(expected));
    }
}

/// A ratio just below 0.5, which the case takes and 0.5 itself it does not.
#[test]
fn a_ratio_of_the_file_is_not_rounded() {
    let deck = "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n*ELEMENT,TYPE=C3D4,ELSET=E\n1,1,2,3,4\n*MATERIAL,NAME=M\n\
        *DENSITY\n7.85e-9\n*ELASTIC\n2.1e5,.4999999999999\n*SOLID SECTION,ELSET=E,MATERIAL=M\n";
    let path = Path::new("a.inp");
    let mut mesh = Mesh::from_bytes(deck.as_bytes(), path, LengthUnit::Metre).unwrap();
    let inspection = crate::app::commands::Inspection::of_mesh(&mesh, None);
    let request = super::DraftRequest {
        mesh: path,
        mesh_in_case: "a.inp",
        title: "a",
        length_unit: None,
        bearing: None,
        straighten: false,
    };
    let found = super::found::find(request, &mut mesh, &inspection).unwrap();
    let text = super::text::case_text(&found).unwrap();
    assert!(text.contains("\npoisson = 0.4999999999999 "), "{text}");
    assert!(text.contains("\nyoung = 2.1e11 ") && text.contains("\ndensity = 7850 "), "{text}");
}

/// A strip of five squares whose lower side bulges by the sagitta `deep`, in sides.
fn bulging(deep: f64) -> Mesh {
    let mut nodes = Vec::new();
    for k in 0..6 {
        let off = f64::from(k) / 2.5 - 1.0;
        nodes.push([f64::from(k), -deep * (1.0 - off * off)]);
        nodes.push([f64::from(k), 1.0]);
    }
    let mut text = String::from(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n2 1 \"plate\"\n1 2 \"side\"\n$EndPhysicalNames\n$Nodes\n12\n",
    );
    for (node, [x, y]) in nodes.iter().enumerate() {
        text += &format!("{} {x} {y} 0\n", node + 1);
    }
    text += "$EndNodes\n$Elements\n10\n";
    for k in 0..5 {
        let first = 2 * k + 1;
        let (second, upper, left) = (first + 2, first + 3, first + 1);
        text += &format!("{} 3 2 1 1 {first} {second} {upper} {left}\n", first);
        text += &format!("{} 1 2 2 2 {first} {second}\n", first + 1);
    }
    text += "$EndElements\n";
    Mesh::from_gmsh_bytes(text.as_bytes(), Path::new("strip.msh"), LengthUnit::Metre).unwrap()
}

/// Coordinates that were rounded put a straight side on an arc of a radius of millions of sides.
#[test]
fn a_straight_side_is_no_round_surface() {
    let outside = |deep: f64| {
        let mesh = bulging(deep);
        let rim = crate::fe::mesh::Rim::of(&mesh, 2);
        let found = super::bore::cylinders(&mesh, 2, &rim, |_| true);
        assert_eq!(found.bore, None);
        found.outside.len()
    };
    assert_eq!(outside(1e-6), 0);
    // 0.7 sides deep in five: 63 degrees of a circle
    assert_eq!(outside(0.7), 1);
}
