//! Where Table 1's contact stiffness may come from: what mistakes in Hertz' theory give.
//!
//! The geometry gives three times Table 1's figures, and the inner race the stiffer one; in Table 1 it is the softer one.
//! Whatever acts on both contacts alike (units, moduli) keeps their ratio of 1.114, so it cannot explain Table 1's 0.990.

use crate::paper::{Failure, TABLE_ONE};
use crate::tables::signed;
use plummer::app::verification::BEARING;
use plummer::bearing::BearingError;
use plummer::bearing::hertz::{HertzStiffness, PrincipalCurvatures, effective_modulus, stiffness};
use plummer::report::{Cell, Column, Section, Table, significant};

/// Young's modulus of bearing steel, Pa.
const STEEL: f64 = 206e9;

/// Poisson's ratio of steel.
const POISSON: f64 = 0.3;

/// Two places at which handbooks tabulate the approach over F(rho), around 0.36 to 0.40; between them they interpolate.
const TABULATED: [f64; 2] = [0.3204, 0.4795];

/// A way to arrive at two stiffnesses.
#[derive(Debug, Clone, PartialEq)]
pub struct Hypothesis {
    /// What was done.
    pub what: String,
    /// Inner race, N/m^(3/2); `None`: theory refuses it.
    pub inner: Option<f64>,
    /// Outer race, N/m^(3/2); `None`: theory refuses it.
    pub outer: Option<f64>,
    /// Relative distances from Table 1.
    pub misfit: [Option<f64>; 2],
}

/// Curvature sum and difference of a contact.
#[derive(Debug, Clone, Copy)]
struct Contact {
    sum: f64,
    difference: f64,
}

/// How one race's contact with a ball is put together, radii in m, a sign each: +1 convex, -1 concave, 0 left out.
#[derive(Debug, Clone, Copy)]
struct RaceCurvatures {
    ball: f64,
    groove: f64,
    groove_sign: f64,
    race: f64,
    race_sign: f64,
    /// The second bracket of (22) with a plus, as printed.
    plus: bool,
}

impl RaceCurvatures {
    /// The contacts as they are: the inner race convex along, both grooves concave across.
    fn right() -> [Self; 2] {
        let race = |groove, race, race_sign| Self {
            ball: BEARING.ball_radius,
            groove,
            groove_sign: -1.0,
            race,
            race_sign,
            plus: false,
        };
        [
            race(BEARING.inner_groove_radius, BEARING.inner_race_radius, 1.0),
            race(BEARING.outer_groove_radius, BEARING.outer_race_radius, -1.0),
        ]
    }

    /// Every radius of Table 1 taken as positive, and (22) as it is printed.
    fn literal() -> [Self; 2] {
        Self::right().map(|race| Self { groove_sign: 1.0, race_sign: 1.0, plus: true, ..race })
    }

    fn contact(&self) -> Contact {
        let across = self.groove_sign / self.groove;
        let along = self.race_sign / self.race;
        let sum = 2.0 / self.ball + across + along;
        let bracket = if self.plus { across + along } else { across - along };
        Contact { sum, difference: bracket.abs() / sum }
    }
}

impl Contact {
    /// Hertz theory with this sum and difference, whatever they were made of.
    fn hertz(self, modulus: f64) -> Result<HertzStiffness, BearingError> {
        let relative = PrincipalCurvatures {
            plane_1: 0.5 * self.sum * (1.0 - self.difference),
            plane_2: 0.5 * self.sum * (1.0 + self.difference),
        };
        stiffness(relative, PrincipalCurvatures::flat(), modulus)
    }

    /// The same with the approach interpolated between [`TABULATED`] values.
    fn interpolated_in_a_table(self, modulus: f64) -> Result<f64, BearingError> {
        let at = |difference| {
            let there = Self { difference, ..self };
            there.hertz(modulus)
        };
        let [low, high] = TABULATED;
        let share = (self.difference - low) / (high - low);
        let approach = (1.0 - share) * at(low)?.approach + share * at(high)?.approach;
        let exact = self.hertz(modulus)?;
        Ok(exact.stiffness * (exact.approach / approach).powf(1.5))
    }
}

/// Two stiffnesses under a name.
fn hypothesis(what: impl Into<String>, found: [Result<f64, BearingError>; 2]) -> Hypothesis {
    let [inner, outer] = found.map(Result::ok);
    Hypothesis {
        what: what.into(),
        misfit: [inner.map(|k| k / TABLE_ONE[0] - 1.0), outer.map(|k| k / TABLE_ONE[1] - 1.0)],
        inner,
        outer,
    }
}

impl Hypothesis {
    /// The larger of both distances from Table 1; infinite where theory refuses.
    pub fn worst(&self) -> f64 {
        let magnitude = |misfit: Option<f64>| misfit.map_or(f64::INFINITY, f64::abs);
        magnitude(self.misfit[0]).max(magnitude(self.misfit[1]))
    }

    /// Inner over outer stiffness.
    pub fn ratio(&self) -> Option<f64> {
        Some(self.inner? / self.outer?)
    }
}

/// All that was tried, the nearest to Table 1 first.
///
/// # Errors
/// What Hertz theory refuses of the right geometry, which is nothing.
pub fn hypotheses() -> Result<Vec<Hypothesis>, Failure> {
    let modulus_of = |young: f64| effective_modulus([young; 2], [POISSON; 2]);
    let modulus = modulus_of(STEEL)?;
    let of = |races: [RaceCurvatures; 2], modulus: f64| {
        races.map(|race| race.contact().hertz(modulus).map(|found| found.stiffness))
    };
    let scaled = |factor: f64| of(RaceCurvatures::right(), modulus).map(|k| k.map(|k| factor * k));
    let changed = |change: &dyn Fn(RaceCurvatures) -> RaceCurvatures| RaceCurvatures::right().map(change);
    let mut all = vec![
        hypothesis("geometry, 206 GPa", scaled(1.0)),
        hypothesis("geometry, 200 GPa", of(RaceCurvatures::right(), modulus_of(200e9)?)),
        hypothesis("geometry, 210 GPa", of(RaceCurvatures::right(), modulus_of(210e9)?)),
        hypothesis("the same per N/mm^(3/2), turned with 10^4 instead of 10^4.5", scaled(10_f64.powf(-0.5))),
        hypothesis("E' = E/(1 - nu^2) in the place of half of it", scaled(2.0)),
        hypothesis("a quarter of E/(1 - nu^2): the half taken twice", scaled(0.5)),
        hypothesis("Poisson's ratio left out", scaled(1.0 - POISSON * POISSON)),
        hypothesis("diameters in the place of radii", scaled(std::f64::consts::SQRT_2)),
        hypothesis("half the radii in the place of radii", scaled(std::f64::consts::FRAC_1_SQRT_2)),
        hypothesis(
            "kappa not used: the approach of a circular patch",
            RaceCurvatures::right().map(|race| {
                let found = race.contact().hertz(modulus)?;
                Ok(found.stiffness * found.approach.powf(1.5))
            }),
        ),
        hypothesis(
            "groove radii left out: ball on cylinders",
            of(changed(&|race| RaceCurvatures { groove_sign: 0.0, ..race }), modulus),
        ),
        hypothesis(
            "race radii left out: ball in straight grooves",
            of(changed(&|race| RaceCurvatures { race_sign: 0.0, ..race }), modulus),
        ),
        hypothesis(
            "both left out: ball on a flat",
            of(changed(&|race| RaceCurvatures { groove_sign: 0.0, race_sign: 0.0, ..race }), modulus),
        ),
        hypothesis("groove radii exchanged between the races", of(swapped_grooves(RaceCurvatures::right()), modulus)),
        hypothesis("(22) as printed, signs right", of(changed(&|race| RaceCurvatures { plus: true, ..race }), modulus)),
        hypothesis(
            "grooves taken as convex, races right",
            of(changed(&|race| RaceCurvatures { groove_sign: 1.0, ..race }), modulus),
        ),
        hypothesis(
            "every radius positive, (22) put right",
            of(RaceCurvatures::literal().map(|race| RaceCurvatures { plus: false, ..race }), modulus),
        ),
    ];
    let [inner, outer] = scaled(1.0);
    let series = |inner: f64, outer: f64| (inner.powf(-2.0 / 3.0) + outer.powf(-2.0 / 3.0)).powf(-1.5);
    let both = series(inner?, outer?);
    all.push(hypothesis("both contacts in series, for each", [Ok(both), Ok(both)]));
    // Palmgren's line contact of the ball's diameter: 8.06e4 l^(8/9) N/mm^(10/9), l in mm
    let line = 8.06e4 * (2e3 * BEARING.ball_radius).powf(8.0 / 9.0) * 1e3_f64.powf(10.0 / 9.0);
    all.push(hypothesis("line contact of a roller as long as the ball is thick (N/m^(10/9))", [Ok(line), Ok(line)]));
    for (young, steel) in [(206e9, "206 GPa"), (200e9, "200 GPa")] {
        let modulus = modulus_of(young)?;
        let literal = RaceCurvatures::literal();
        let with = |what: &str| format!("every radius positive, (21) and (22) as printed, {steel}{what}");
        all.push(hypothesis(with(""), of(literal, modulus)));
        all.push(hypothesis(with(", groove radii exchanged"), of(swapped_grooves(literal), modulus)));
        all.push(hypothesis(
            with(", approach interpolated in a table"),
            literal.map(|race| race.contact().interpolated_in_a_table(modulus)),
        ));
        all.push(hypothesis(
            with(", groove radii exchanged, approach interpolated in a table"),
            swapped_grooves(literal).map(|race| race.contact().interpolated_in_a_table(modulus)),
        ));
    }
    all.sort_by(|a, b| a.worst().total_cmp(&b.worst()));
    Ok(all)
}

fn swapped_grooves([inner, outer]: [RaceCurvatures; 2]) -> [RaceCurvatures; 2] {
    [RaceCurvatures { groove: outer.groove, ..inner }, RaceCurvatures { groove: inner.groove, ..outer }]
}

/// Why Table 1's contact stiffness is a third of Hertz': the table of all hypotheses, and what follows from the nearest.
pub fn section(hypotheses: &[Hypothesis]) -> Section {
    let [inner, outer] = TABLE_ONE;
    let mut section = Section::new("Where Table 1's contact stiffness may come from")
        .paragraph(format!(
            "Table 1 prints a contact stiffness of {} and {} N/m^(3/2), a third of what its own radii give, and softer at the inner race where the radii make it stiffer. Whatever acts on both contacts alike, such as units or moduli, keeps their ratio of 1.114; Table 1 has 0.990. The slips below were tried. None gives both of its four-digit numbers. The nearest are those that take every radius of Table 1 as positive, the concave grooves too, in the equations (21) and (22) as they are printed.",
            significant(inner, 4),
            significant(outer, 4)
        ))
        .table(table(hypotheses));
    if let Some([inner, outer]) = moduli(hypotheses) {
        section = section.paragraph(format!(
            "Read in this way, Table 1 needs steel of {} GPa at the inner race and of {} GPa at the outer one: the same within 1 %, and a usual figure for steel, but not the same to four digits. It is a likely origin, not a proven one.",
            significant(1e-9 * inner, 4),
            significant(1e-9 * outer, 4)
        ));
    }
    if let Some(force) = tangent_force(hypotheses) {
        section = section.paragraph(format!(
            "The unit in Table 1 is N/m. As the slope of the force over the approach its figure would belong to a load of {} N, with the stiffness that the geometry gives.",
            significant(force, 2)
        ));
    }
    section
}

/// Force at which the inner contact's slope, 1.5 k^(2/3) F^(1/3), is Table 1's number, N.
fn tangent_force(hypotheses: &[Hypothesis]) -> Option<f64> {
    let geometry = hypotheses.iter().find(|hypothesis| hypothesis.what == "geometry, 206 GPa")?;
    let k = geometry.inner?;
    Some((TABLE_ONE[0] / 1.5).powi(3) / (k * k))
}

/// Young's modulus with which every radius taken as positive gives Table 1's numbers, Pa: k goes with it.
fn moduli(hypotheses: &[Hypothesis]) -> Option<[f64; 2]> {
    let literal = hypotheses
        .iter()
        .find(|hypothesis| hypothesis.what == "every radius positive, (21) and (22) as printed, 206 GPa")?;
    let [inner, outer] = literal.misfit;
    Some([206e9 / (1.0 + inner?), 206e9 / (1.0 + outer?)])
}

/// All hypotheses, the nearest first, and Table 1 itself.
pub fn table(hypotheses: &[Hypothesis]) -> Table {
    let columns = [
        Column::text("What was done"),
        Column::number("Inner race", "10^9 N/m^(3/2)"),
        Column::number("Outer race", "10^9 N/m^(3/2)"),
        Column::number("Their ratio", ""),
        Column::number("Inner against Table 1", "%"),
        Column::number("Outer against Table 1", "%"),
    ];
    let mut table = Table::new("Where Table 1's contact stiffness may come from", columns);
    let blank = |cell: Option<Cell>| cell.unwrap_or_else(|| Cell::text("F ≥ 1"));
    for hypothesis in hypotheses {
        let stiffness = |k: Option<f64>| blank(k.map(|k| Cell::number(1e-9 * k, 4)));
        let off = |misfit: Option<f64>| {
            let cell = misfit.map(|misfit| Cell::text(signed(100.0 * misfit)).value(100.0 * misfit));
            cell.unwrap_or_else(|| Cell::text("–"))
        };
        table = table.row([
            Cell::text(&hypothesis.what),
            stiffness(hypothesis.inner),
            stiffness(hypothesis.outer),
            hypothesis.ratio().map_or_else(|| Cell::text("–"), |ratio| Cell::number(ratio, 4)),
            off(hypothesis.misfit[0]),
            off(hypothesis.misfit[1]),
        ]);
    }
    table.row([
        Cell::text("Table 1 itself"),
        Cell::number(1e-9 * TABLE_ONE[0], 4),
        Cell::number(1e-9 * TABLE_ONE[1], 4),
        Cell::number(TABLE_ONE[0] / TABLE_ONE[1], 4),
        Cell::text("–"),
        Cell::text("–"),
    ])
}

#[cfg(test)]
mod tests {
    use super::*;
    use plummer::bearing::{BearingGeometry, ContactMaterial, RaceContacts};

    fn found(what: &str) -> Hypothesis {
        let all = hypotheses().unwrap();
        let same = |hypothesis: &&Hypothesis| hypothesis.what == what;
        all.iter().find(same).expect(what).clone()
    }

    #[test]
    fn the_right_curvatures_give_the_bearings_own_stiffness() {
        let geometry = BearingGeometry::new(BEARING).unwrap();
        let steel = ContactMaterial { young: STEEL, poisson: POISSON };
        let own = RaceContacts::new(&geometry, steel, steel, steel).unwrap();
        let here = found("geometry, 206 GPa");
        // the same theory by way of sum and difference, whose 1 - F cancels two digits
        assert!((here.inner.unwrap() / own.inner.stiffness - 1.0).abs() < 1e-12);
        assert!((here.outer.unwrap() / own.outer.stiffness - 1.0).abs() < 1e-12);
        assert!((here.ratio().unwrap() - 1.1138).abs() < 1e-4);
    }

    /// Computed in Python with SciPy's elliptic integrals.
    #[test]
    fn slips_agree_with_another_computation() {
        for (what, inner, outer) in [
            ("both left out: ball on a flat", 4.7724e9, 4.7724e9),
            ("every radius positive, (22) put right", 3.7424e9, 3.8757e9),
            ("every radius positive, (21) and (22) as printed, 206 GPa", 3.9221e9, 3.9913e9),
            ("every radius positive, (21) and (22) as printed, 206 GPa, groove radii exchanged", 3.9320e9, 3.9804e9),
        ] {
            let found = found(what);
            // five digits were printed
            assert!((found.inner.unwrap() / inner - 1.0).abs() < 2e-5, "{what}");
            assert!((found.outer.unwrap() / outer - 1.0).abs() < 2e-5, "{what}");
        }
        // the outer race has F = 1.34 then
        assert_eq!(found("(22) as printed, signs right").outer, None);
    }

    #[test]
    fn the_nearest_stand_first_and_none_has_table_1s_four_digits() {
        let all = hypotheses().unwrap();
        assert!(all.windows(2).all(|pair| pair[0].worst() <= pair[1].worst()));
        // half a unit in Table 1's last digit
        assert!(all[0].worst() > 0.0005 / 3.828);
        assert!(all[0].worst() < 0.005);
    }
}
