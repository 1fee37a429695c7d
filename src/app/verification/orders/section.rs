//! The section of the suite: solids, rings and steps.
//!
//! Curved beams on a thick free ring.
//!
//! Elements of solids on standing waves in a box.
//!
//! Integrators on the preloaded bearing: the same signal with ever smaller steps.

use super::super::beams::ring;
use super::super::section::{SMOOTH, built_in};
use super::super::structured_mesh::{BODY, StructuredMesh};
use super::{Family, series};
use crate::app::commands::run::compute_run;
use crate::app::verification::section::{OrdersSummary, SectionResult, VerificationError};
use crate::fe::assembly::SystemMatrices;
use crate::fe::element::continuum::{Formulation, Integration, LinearFormulation};
use crate::fe::material::Material;
use crate::fe::mesh::ElementKind;
use crate::fe::modal::{ModalBasis, ModeRange};
use crate::fe::model::{HousingDescription, HousingModel, HousingPart};
use crate::numerics::Unwatched;
use crate::numerics::linalg::{EigenProblem, symmetric_generalised_eigen};
use crate::numerics::series::TimeSeries;
use crate::report::Section;
use nalgebra::Vector3;
use std::f64::consts::{PI, TAU};

/// Title of the section.
const TITLE: &str = "Orders of convergence";

/// Carries the section out.
///
/// # Errors
/// [`VerificationError`] if a model cannot be built or computed.
pub(crate) fn orders() -> Result<SectionResult, VerificationError> {
    let families = [solids()?, rings()?, steps()?];
    let checks = families.iter().flat_map(Family::checks).collect();
    let mut report = Section::new(TITLE).paragraph(
        "The order is the slope of the error over the size on logarithmic axes, from one size to the next; the check judges the last.",
    );
    for family in &families {
        report = report.table(family.table()).plot(family.plot());
    }
    let mut section = SectionResult::of_checks(TITLE, checks);
    section.report = vec![report];
    section.orders = Some(families.into_iter().flat_map(|family| family.series).collect());
    Ok(section)
}

/// Elements of the coarsest ring; each of the others has twice as many as the one before.
const ELEMENTS: usize = 24;
/// Rings: of so many, all but the last are compared with the next.
const RINGS: u32 = 4;
/// Radius over thickness.
const SLENDERNESS: f64 = 5.0;

/// What a size is, and its unit.
const SIZE: [&str; 2] = ["Arc of an element", "rad"];

pub(super) fn rings() -> Result<Family, VerificationError> {
    let squared = (0..RINGS).map(|halving| {
        let ring = ring(ELEMENTS << halving, SLENDERNESS)?;
        let modes = symmetric_generalised_eigen(ring.stiffness(), ring.mass())?;
        Ok(modes.values)
    });
    let squared = squared.collect::<Result<Vec<_>, VerificationError>>()?;
    let of_waves = |waves: usize| {
        // three rigid motions, then a pair for each number of waves
        let frequency = |values: &Vec<f64>| values[2 * waves - 1].sqrt();
        let pairs = squared.windows(2);
        series(
            format!("thick ring with {waves} waves"),
            SIZE,
            (0..RINGS - 1).map(|halving| TAU / (ELEMENTS << halving) as f64).collect(),
            pairs.map(|pair| frequency(&pair[0]) / frequency(&pair[1]) - 1.0).collect(),
            [2.0, 0.05],
        )
    };
    Ok(Family {
        title: "Frequencies of a ring of beams",
        source: "What inertia between exact nodes leaves out: shear and stretch under the load p L inside an element, of second order in its length L",
        assumptions: "Free ring, radius over thickness 5, 24 to 192 exact arcs; error: the difference from the ring of twice as many elements.",
        reason: "The next term, of fourth order, is less than a tenth of the first at 96 elements.",
        series: (2..=4).map(of_waves).collect(),
    })
}

/// The box, m.
const BOX: [f64; 3] = [1.0, 0.8, 0.25];
/// Cells along the edges of the coarsest mesh.
const CELLS: [usize; 3] = [4, 3, 1];
/// Young's modulus, Pa, Poisson's ratio, density, kg/m^3: any will do.
const MATERIAL: [f64; 3] = [2.5, 0.3, 1.6];
/// Modes compared: shear waves, and the pressure waves along the two longer sides.
const MODES: usize = 4;
/// Modes among which they are told by their shapes: in Hex8 with incompatible modes the third and the fourth, 0.9 % apart,
/// change places on coarse meshes.
const LOOKED_AT: usize = 8;
/// Half waves along an edge that are looked at.
const HALF_WAVES: usize = 9;

/// An element, how its stiffness is formed, how often each mesh divides the coarsest, and the limit of the order.
type Row = (ElementKind, LinearFormulation, &'static [usize], f64);

const ROWS: [Row; 9] = [
    (ElementKind::Hex8, LinearFormulation::Plain, &[1, 2, 4], 0.05),
    (ElementKind::Hex8, LinearFormulation::Incompatible, &[1, 2, 4], 0.05),
    (ElementKind::Hex20, LinearFormulation::Plain, &[1, 2, 3], 0.025),
    (ElementKind::Tet10, LinearFormulation::Plain, &[1, 2, 3], 0.075),
    (ElementKind::Hex27, LinearFormulation::Plain, &[1, 2, 3], 0.025),
    (ElementKind::Wedge18, LinearFormulation::Plain, &[1, 2, 3], 0.075),
    (ElementKind::Pyramid5, LinearFormulation::Plain, &[1, 2, 3], 0.05),
    (ElementKind::Pyramid13, LinearFormulation::Plain, &[1, 2], 0.025),
    (ElementKind::Pyramid14, LinearFormulation::Plain, &[1, 2], 0.05),
];

/// What a size is, and its unit.
const SOLID_SIZE: [&str; 2] = ["Element size", "m"];

pub(super) fn solids() -> Result<Family, VerificationError> {
    let mut all = Vec::new();
    for (kind, linear, divisions, limit) in ROWS {
        all.extend(of_element(kind, linear, divisions, limit)?);
    }
    Ok(Family {
        title: "Frequencies of solids",
        source: "Strang and Fix, An Analysis of the Finite Element Method, ch. 6: eigenvalues converge with order 2 p, p the degree. Standing waves in closed form",
        assumptions: "Box of 1 x 0.8 x 0.25 m between frictionless rigid walls. Frequencies: f = c |k| / (2 pi), k = pi (l/L, m/W, n/H). The speed c is that of shear waves and of pressure waves. Meshes of 4 x 3 x 1 cells, divided further.",
        reason: "Theory is for sizes that go to zero: 0.1 of the order with hexahedra and pyramids, 0.2 with Pyramid14. Six tetrahedra or two wedges a cell are coarser along one diagonal and up to 0.3 away at three divisions, rising.",
        series: all,
    })
}

fn of_element(
    kind: ElementKind,
    linear: LinearFormulation,
    divisions: &[usize],
    limit: f64,
) -> Result<Vec<OrdersSummary>, VerificationError> {
    let exact = standing_waves()?;
    let found = divisions.iter().map(|&n| frequencies(kind, linear, n, &exact[..MODES]));
    let found = found.collect::<Result<Vec<_>, _>>()?;
    let incompatible = kind == ElementKind::Hex8 && linear == LinearFormulation::Incompatible;
    let name = if incompatible { "Hex8 incompatible" } else { kind.name() };
    let degree = kind.order() as f64;
    let of_mode = |mode: usize| {
        let sizes = divisions.iter().map(|&n| BOX[2] / n as f64).collect();
        let errors = found.iter().map(|found| found[mode] / exact[mode].frequency_hz - 1.0).collect();
        series(format!("{name}, wave {}", mode + 1), SOLID_SIZE, sizes, errors, [2.0 * degree, limit])
    };
    Ok((0..MODES).map(of_mode).collect())
}

fn material() -> Result<Material, VerificationError> {
    let [young, poisson, density] = MATERIAL;
    Ok(Material::new(young, poisson, density)?)
}

/// A standing wave in the box: `u_i = A_i sin(k_i x_i) cos cos`, with the wave numbers k.
struct Wave {
    frequency_hz: f64,
    wave_numbers: Vector3<f64>,
    /// A, along k or across it.
    amplitude: Vector3<f64>,
}

impl Wave {
    /// One component of its displacement.
    fn at(&self, place: [f64; 3], axis: usize) -> f64 {
        let factor = |i: usize| {
            let (sine, cosine) = (self.wave_numbers[i] * place[i]).sin_cos();
            if i == axis { sine } else { cosine }
        };
        self.amplitude[axis] * factor(0) * factor(1) * factor(2)
    }
}

/// Standing waves in the box, by rising frequency.
fn standing_waves() -> Result<Vec<Wave>, VerificationError> {
    let material = material()?;
    let mu = material.shear_modulus();
    let pressure = ((material.lame_lambda() + 2.0 * mu) / material.density).sqrt();
    let shear = (mu / material.density).sqrt();
    let mut found = Vec::new();
    for index in 1..HALF_WAVES.pow(3) {
        let count = [index % HALF_WAVES, index / HALF_WAVES % HALF_WAVES, index / HALF_WAVES.pow(2)];
        let wave_numbers = Vector3::from_fn(|i, _| PI * count[i] as f64 / BOX[i]);
        let mut add = |speed: f64, amplitude: Vector3<f64>| {
            let frequency_hz = speed * wave_numbers.norm() / TAU;
            found.push(Wave { frequency_hz, wave_numbers, amplitude });
        };
        add(pressure, wave_numbers);
        // across k, without the directions whose sine vanishes
        let without = count.iter().position(|&n| n == 0);
        let across = wave_numbers.cross(&Vector3::ith(without.unwrap_or(2), 1.0));
        match count.iter().filter(|&&n| n > 0).count() {
            2 => add(shear, across),
            3 => [across, wave_numbers.cross(&across)].into_iter().for_each(|amplitude| add(shear, amplitude)),
            _ => {}
        }
    }
    found.sort_by(|a, b| a.frequency_hz.total_cmp(&b.frequency_hz));
    Ok(found)
}

/// The frequencies of waves in a mesh, Hz: of each the mode whose displacements are most like it.
fn frequencies(
    kind: ElementKind,
    linear: LinearFormulation,
    divisions: usize,
    waves: &[Wave],
) -> Result<Vec<f64>, VerificationError> {
    let mesh = StructuredMesh::new(kind, CELLS.map(|n| n * divisions), |x| [0, 1, 2].map(|i| BOX[i] * x[i]));
    let description = HousingDescription {
        parts: vec![HousingPart { group: BODY.to_owned(), material: material()?.into() }],
        formulation: Formulation { integration: Integration::Full, linear },
        ..HousingDescription::default()
    };
    let model = HousingModel::new(&mesh.mesh, description)?;
    let matrices = SystemMatrices::assemble(&model)?;
    let mut free = model.free_dofs();
    free.retain(|dof| !mesh.is_on_face(dof / 3, dof % 3));
    let problem = EigenProblem::restricted(&matrices.stiffness, &matrices.mass, &free)?;
    let basis = ModalBasis::of(&problem, ModeRange::Count(LOOKED_AT))?;
    let likeness = |wave: &Wave, mode: usize| {
        let shape = basis.shapes.col(mode);
        let products = free.iter().zip(shape.iter()).map(|(dof, own)| own * wave.at(mesh.mesh.nodes[dof / 3], dof % 3));
        products.sum::<f64>().abs() / shape.iter().map(|own| own * own).sum::<f64>().sqrt()
    };
    let nearest = |wave: &Wave| {
        let modes = 0..basis.frequencies_hz.len();
        let found = modes.max_by(|&a, &b| likeness(wave, a).total_cmp(&likeness(wave, b)));
        found.map_or(f64::NAN, |mode| basis.frequencies_hz[mode])
    };
    Ok(waves.iter().map(nearest).collect())
}

/// Rate of the signals, Hz; steps divide its interval.
const OUTPUT_HZ: f64 = 400e3;
/// Steps in an interval, from coarse to fine.
const STEPS: [u32; 3] = [8, 16, 32];

/// Methods, and the order of each.
const METHODS: [(&str, f64); 5] = [
    ("exponential", 2.0),
    ("exponential-adams", 3.0),
    ("newmark-explicit", 2.0),
    ("newmark", 2.0),
    ("generalized-alpha", 2.0),
];

/// What a size is, and its unit.
const STEP: [&str; 2] = ["Step", "s"];

pub(super) fn steps() -> Result<Family, VerificationError> {
    let steps = STEPS.map(|count| 1.0 / (OUTPUT_HZ * f64::from(count)));
    let exact = |step: &f64| signal("dop853", *step, Some("transient.tolerance=1e-12"));
    let exact = steps.iter().map(exact);
    let exact = exact.collect::<Result<Vec<_>, VerificationError>>()?;
    let mut all = Vec::new();
    for (method, theory) in METHODS {
        let errors = steps.iter().zip(&exact);
        let errors = errors.map(|(&step, exact)| Ok(difference(&signal(method, step, None)?, exact)));
        let errors = errors.collect::<Result<_, VerificationError>>()?;
        all.push(series(method.to_owned(), STEP, steps.to_vec(), errors, [theory, 0.05]));
    }
    Ok(Family {
        title: "Signals by integrators",
        source: "Hairer, Lubich, Wanner, Geometric Numerical Integration, for the second order of one-step methods; Hochbruck, Ostermann, Acta Numerica 19 (2010) 209, for exponential Adams methods",
        assumptions: "examples/scenes/smooth.toml, 0.25 ms from rest with 14 modes: no impact, and no ball passes the end of a ring element, where accelerations have a kink. Root mean square of the acceleration's difference from dop853 at a tolerance of 1e-12, over that of the acceleration. Both are sampled at the step, whose filter they share.",
        reason: "Theory is for steps that go to zero; from the second step to the third the orders are within 2 % of it.",
        series: all,
    })
}

/// Acceleration of the first sensor, by a method with steps or samples of `step` seconds.
fn signal(method: &str, step: f64, key: Option<&str>) -> Result<TimeSeries, VerificationError> {
    let keys = [
        format!("transient.method={method}"),
        format!("transient.step={step:e}"),
        format!("transient.output_hz={OUTPUT_HZ}"),
    ];
    let of_scene = ["transient.modes=14", "transient.end=2.5e-4", "analysis.envelope=[]"];
    let keys = of_scene.into_iter().chain(keys.iter().map(String::as_str)).chain(key);
    let keys: Vec<&str> = keys.collect();
    let run = compute_run(&built_in("smooth.toml", SMOOTH, &keys)?, &Unwatched)?;
    Ok(run.simulation.signal(0)?)
}

/// Root mean square of the difference, over that of the second.
fn difference(found: &TimeSeries, exact: &TimeSeries) -> f64 {
    let square = |values: &mut dyn Iterator<Item = f64>| values.map(|x| x * x).sum::<f64>();
    let pairs = found.values().iter().zip(exact.values());
    let error = square(&mut pairs.map(|(a, b)| a - b));
    (error / square(&mut exact.values().iter().copied())).sqrt()
}

#[cfg(test)]
mod tests {
    use super::orders;

    #[test]
    fn every_order_is_that_of_theory() {
        let section = orders().unwrap();
        for check in &section.checks {
            println!("{}", check.line());
            assert!(check.ok, "{}", check.line());
        }
        assert_eq!(section.checks.len(), 9 * 4 + 3 + 5);
        // conforming elements are too stiff
        let series = section.orders.unwrap();
        for series in series.iter().filter(|series| series.unit == "m" && !series.name.contains("incompatible")) {
            let above = series.relative_errors.iter().all(|&error| error > 0.0);
            assert!(above, "{series:?}");
        }
    }
}
