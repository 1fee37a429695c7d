//! What the paper does not report about its model, and the values that are tried.

/// How the springs of the pedestal act on the ring.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Springs {
    /// In x and in y, on the nodes of the common beam.
    CommonNodes,
    /// In x and in y, on the housing ring's centre line, 7.5 mm.
    CentreLine,
    /// In x and in y, on the housing ring's outside, 9 mm.
    Outside,
    /// Along the radius alone.
    Radial,
}

/// Which nodes have springs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SpringArc {
    /// The 36 from 180 to 355 degrees: the paper's number.
    HalfOpen,
    /// The 37 from 180 to 360 degrees: both ends of the lower half.
    Closed,
}

/// How both rings make one beam.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RingBond {
    /// They slide on each other, each bends on its own radius.
    OwnRadius,
    /// They slide on each other, but bend about the common centroid.
    CommonCentroid,
    /// Bonded: one section.
    Composite,
}

/// Where the contact stiffness comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ContactSource {
    /// Hertz theory, Table 1's radii, 206 GPa.
    Geometry,
    /// Table 1's own figures.
    TableOne,
    /// Hertz theory with the ring steel's modulus.
    RingSteel,
}

/// Which equations.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Equations {
    /// The paper's (3)-(16), misprints put right.
    Printed,
    /// Ball positions from the fixed centre.
    Consistent,
}

/// What a reading chooses, in the order of [`Levels`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Factor {
    /// Width of the housing ring.
    Width,
    /// Directions and attachment of the springs.
    Springs,
    /// Number of springs.
    SpringArc,
    /// How the rings hold together.
    Bond,
    /// Shear of the beam.
    Shear,
    /// Rotary inertia of the beam.
    RotaryInertia,
    /// Young's modulus of the steel ring.
    Steel,
    /// Young's modulus of the aluminium ring.
    Aluminium,
    /// Which equations.
    Equations,
    /// Where the contact stiffness comes from.
    Contact,
    /// Static load on the shaft.
    Load,
    /// Cage angle.
    Cage,
}

/// Number of choices.
pub const FACTORS: usize = 12;

/// Choices that shape the ring; the others leave its matrices alone.
pub const STRUCTURE_FACTORS: usize = 8;

/// Which of a grid's values a reading takes, one index a factor.
pub type Levels = [usize; FACTORS];

impl Factor {
    /// All, in the order of [`Levels`].
    pub const ALL: [Self; FACTORS] = [
        Self::Width,
        Self::Springs,
        Self::SpringArc,
        Self::Bond,
        Self::Shear,
        Self::RotaryInertia,
        Self::Steel,
        Self::Aluminium,
        Self::Equations,
        Self::Contact,
        Self::Load,
        Self::Cage,
    ];

    /// What it is, for the head of a column.
    pub fn name(self) -> &'static str {
        match self {
            Self::Width => "Housing ring's width",
            Self::Springs => "Springs",
            Self::SpringArc => "Number of springs",
            Self::Bond => "Rings",
            Self::Shear => "Shear",
            Self::RotaryInertia => "Rotary inertia",
            Self::Steel => "Steel",
            Self::Aluminium => "Aluminium",
            Self::Equations => "Equations",
            Self::Contact => "Contact stiffness",
            Self::Load => "Load on the shaft",
            Self::Cage => "Balls below",
        }
    }
}

/// The values that are tried: every reading takes one of each.
#[derive(Debug, Clone, PartialEq)]
pub struct Grid {
    /// Widths of the housing ring, m.
    pub widths: Vec<f64>,
    /// Directions and attachments of the springs.
    pub springs: Vec<Springs>,
    /// Numbers of springs.
    pub arcs: Vec<SpringArc>,
    /// How the rings hold together.
    pub bonds: Vec<RingBond>,
    /// Whether the beam shears.
    pub shear: Vec<bool>,
    /// Whether it has rotary inertia.
    pub rotary_inertia: Vec<bool>,
    /// Young's modulus of the steel ring, Pa.
    pub steel: Vec<f64>,
    /// Young's modulus of the aluminium ring, Pa.
    pub aluminium: Vec<f64>,
    /// Equations.
    pub equations: Vec<Equations>,
    /// Sources of the contact stiffness.
    pub contacts: Vec<ContactSource>,
    /// Static load on the shaft in multiples of its weight.
    pub loads: Vec<f64>,
    /// Cage angle between two balls symmetric about the load (0) and one ball under it (1).
    pub cages: Vec<f64>,
}

impl Grid {
    /// Everything that the paper leaves open, in the ranges that its other statements allow.
    pub fn full() -> Self {
        Self {
            widths: vec![3e-3, 3.5e-3, 4e-3, 4.5e-3, 5e-3],
            springs: vec![Springs::CommonNodes, Springs::CentreLine, Springs::Outside, Springs::Radial],
            arcs: vec![SpringArc::HalfOpen, SpringArc::Closed],
            bonds: vec![RingBond::OwnRadius, RingBond::CommonCentroid, RingBond::Composite],
            shear: vec![false, true],
            rotary_inertia: vec![true, false],
            steel: vec![200e9, 206e9, 210e9],
            aluminium: vec![69e9, 72e9],
            equations: vec![Equations::Printed, Equations::Consistent],
            contacts: vec![ContactSource::Geometry, ContactSource::TableOne, ContactSource::RingSteel],
            loads: vec![0.5, 1.0, 2.0],
            cages: vec![0.0, 0.5, 1.0],
        }
    }

    /// Number of values of each factor.
    pub fn sizes(&self) -> Levels {
        [
            self.widths.len(),
            self.springs.len(),
            self.arcs.len(),
            self.bonds.len(),
            self.shear.len(),
            self.rotary_inertia.len(),
            self.steel.len(),
            self.aluminium.len(),
            self.equations.len(),
            self.contacts.len(),
            self.loads.len(),
            self.cages.len(),
        ]
    }

    /// Number of readings.
    pub fn readings(&self) -> usize {
        self.sizes().iter().product()
    }

    /// All combinations of the ring's own choices; those of the bearing are 0.
    pub fn structures(&self) -> Vec<Levels> {
        combinations(&self.sizes(), 0..STRUCTURE_FACTORS)
    }

    /// All combinations of the bearing's choices; those of the ring are 0.
    pub fn bearings(&self) -> Vec<Levels> {
        combinations(&self.sizes(), STRUCTURE_FACTORS..FACTORS)
    }

    /// A value in words; empty if there is none.
    pub fn label(&self, factor: Factor, level: usize) -> String {
        let label = match factor {
            Factor::Width => self.widths.get(level).map(|w| format!("{} mm", 1e3 * w)),
            Factor::Springs => self.springs.get(level).map(|springs| {
                match springs {
                    Springs::CommonNodes => "x, y at the common nodes",
                    Springs::CentreLine => "x, y at the centre line",
                    Springs::Outside => "x, y at the outside",
                    Springs::Radial => "radial",
                }
                .to_owned()
            }),
            Factor::SpringArc => self.arcs.get(level).map(|arc| {
                match arc {
                    SpringArc::HalfOpen => "36",
                    SpringArc::Closed => "37",
                }
                .to_owned()
            }),
            Factor::Bond => self.bonds.get(level).map(|bond| {
                match bond {
                    RingBond::OwnRadius => "slip, own radius",
                    RingBond::CommonCentroid => "slip, common centroid",
                    RingBond::Composite => "bonded",
                }
                .to_owned()
            }),
            Factor::Shear => self.shear.get(level).map(|on| on_or_off(*on)),
            Factor::RotaryInertia => self.rotary_inertia.get(level).map(|on| on_or_off(*on)),
            Factor::Steel => self.steel.get(level).map(gigapascal),
            Factor::Aluminium => self.aluminium.get(level).map(gigapascal),
            Factor::Equations => self.equations.get(level).map(|equations| {
                match equations {
                    Equations::Printed => "printed",
                    Equations::Consistent => "consistent",
                }
                .to_owned()
            }),
            Factor::Contact => self.contacts.get(level).map(|contact| {
                match contact {
                    ContactSource::Geometry => "geometry, 206 GPa",
                    ContactSource::TableOne => "Table 1",
                    ContactSource::RingSteel => "geometry, ring's steel",
                }
                .to_owned()
            }),
            Factor::Load => self.loads.get(level).map(|load| {
                let one = (load - 1.0).abs() < f64::EPSILON;
                format!("{load} {}", if one { "weight" } else { "weights" })
            }),
            Factor::Cage => self.cages.get(level).map(|place| {
                if *place <= 0.0 {
                    "two".to_owned()
                } else if *place >= 1.0 {
                    "one".to_owned()
                } else {
                    format!("{} of the way to one", place)
                }
            }),
        };
        label.unwrap_or_default()
    }

    /// Where the reading stands that the repository's case `examples/tadina2011/beam.toml` takes; `None` if this grid lacks
    /// one of its values.
    pub fn known(&self) -> Option<Levels> {
        let number = |values: &[f64], wanted: f64| {
            let near = |value: &f64| (value / wanted - 1.0).abs() < 1e-9;
            values.iter().position(near)
        };
        Some([
            number(&self.widths, 4e-3)?,
            place(&self.springs, &Springs::CentreLine)?,
            place(&self.arcs, &SpringArc::HalfOpen)?,
            place(&self.bonds, &RingBond::CommonCentroid)?,
            place(&self.shear, &false)?,
            place(&self.rotary_inertia, &true)?,
            number(&self.steel, 210e9)?,
            number(&self.aluminium, 72e9)?,
            place(&self.equations, &Equations::Printed)?,
            place(&self.contacts, &ContactSource::Geometry)?,
            number(&self.loads, 1.0)?,
            self.cages.iter().position(|cage| *cage <= 0.0)?,
        ])
    }
}

fn place<T: PartialEq>(values: &[T], wanted: &T) -> Option<usize> {
    values.iter().position(|value| value == wanted)
}

fn on_or_off(on: bool) -> String {
    if on { "on" } else { "off" }.to_owned()
}

fn gigapascal(young: &f64) -> String {
    format!("{} GPa", 1e-9 * young)
}

/// All combinations of the factors in `range`, the others 0; the last one runs fastest.
fn combinations(sizes: &Levels, range: std::ops::Range<usize>) -> Vec<Levels> {
    let mut all = vec![[0; FACTORS]];
    for factor in range {
        let longer = all.iter().flat_map(|levels| {
            (0..sizes[factor]).map(move |level| {
                let mut levels = *levels;
                levels[factor] = level;
                levels
            })
        });
        all = longer.collect();
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_combination_stands_once_and_every_value_has_words() {
        let grid = Grid::full();
        let (structures, bearings) = (grid.structures(), grid.bearings());
        assert_eq!(structures.len() * bearings.len(), grid.readings());
        let distinct: std::collections::HashSet<_> = structures.iter().collect();
        assert_eq!(distinct.len(), structures.len());
        assert_eq!(structures[1][STRUCTURE_FACTORS - 1], 1);
        for (factor, size) in Factor::ALL.into_iter().zip(grid.sizes()) {
            let words: std::collections::HashSet<_> = (0..size).map(|level| grid.label(factor, level)).collect();
            assert_eq!(words.len(), size, "{}", factor.name());
            assert!(!words.contains("") && grid.label(factor, size).is_empty());
        }
        let known = grid.known().unwrap();
        assert_eq!(grid.label(Factor::Width, known[0]), "4 mm");
        assert_eq!(grid.label(Factor::Cage, known[11]), "two");
    }
}
