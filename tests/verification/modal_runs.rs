//! Reference: the second eigensolver (shift-invert ARPACK from the middle of a band, factor in double precision with
//!   pivots) and the dense one, against the block iteration with its factor in single precision; and what is known of
//!   models on which modal computations fail elsewhere.
//! Goal: the right number of modes with the right frequencies, or a clear error, on every one of them.
//! Sketch: pillow blocks of tet10; a block in two parts of hex20 and tet10; a ring of hex20.
//! Conditions: in each test.
//! Parameters: aluminium unless said.
//!
//! Limits: both solvers find eigenvalues of the same matrices: they agree within the sum of their printed bounds.

use crate::reference_frequencies::data;
use plummer::fe::assembly::SystemMatrices;
use plummer::fe::material::Material;
use plummer::fe::mesh::Mesh;
use plummer::fe::modal::{Mechanisms, ModalBasis, ModeRange, over_all_dofs, strain_products};
use plummer::fe::model::{
    Connection, Constraint, HousingDescription, HousingModel, HousingPart, HousingSupport, Link, SpringStiffness,
    SupportShare,
};
use plummer::numerics::linalg::{DenseMatrix, EigenProblem, LinalgError, submatrix};
use plummer::numerics::units::LengthUnit;

const ALUMINIUM: [f64; 3] = [70e9, 0.33, 2700.0];

struct Run {
    mesh: Mesh,
    model: HousingModel,
    problem: EigenProblem,
}

impl Run {
    fn new(file: &str, parts: &[(&str, [f64; 3])], description: HousingDescription) -> Self {
        let unit = match file {
            "two_blocks.msh" => LengthUnit::Millimetre,
            _ => LengthUnit::Metre,
        };
        let mesh = Mesh::read_gmsh(&data(file), unit).unwrap();
        let parts = parts.iter().map(|&(group, [young, poisson, density])| HousingPart {
            group: group.to_owned(),
            material: Material::new(young, poisson, density).unwrap().into(),
        });
        let description = HousingDescription { parts: parts.collect(), ..description };
        let model = HousingModel::new(&mesh, description).unwrap();
        let SystemMatrices { stiffness, mass, .. } = SystemMatrices::assemble(&model).unwrap();
        let problem = EigenProblem::restricted(&stiffness, &mass, &model.free_dofs()).unwrap();
        Self { mesh, model, problem }
    }

    fn modes(&self, range: ModeRange) -> ModalBasis {
        let mut basis = self.by_matrices(range);
        let free = self.model.free_dofs();
        let products = |shapes: &DenseMatrix| strain_products(&self.model, &over_all_dofs(&self.model, &free, shapes)?);
        basis.sharpen(products).unwrap();
        basis
    }

    /// Without the energies of elements.
    fn by_matrices(&self, range: ModeRange) -> ModalBasis {
        ModalBasis::of(&self.problem, range).unwrap()
    }

    fn free_motions(&self) -> Mechanisms {
        Mechanisms::find(&self.mesh, &self.model).unwrap()
    }
}

fn held(group: &str, fixed: [bool; 3]) -> HousingDescription {
    HousingDescription {
        supports: vec![HousingSupport {
            group: group.to_owned(),
            constraint: Constraint::Fixed(fixed),
            share: SupportShare::PerNode,
        }],
        ..HousingDescription::default()
    }
}

/// Both lists are of the same length and agree within the sum of their bounds.
fn assert_agree(a: &ModalBasis, b: &ModalBasis) {
    assert_eq!(a.count(), b.count());
    for mode in 0..a.count() {
        let difference = (a.frequencies_hz[mode] - b.frequencies_hz[mode]).abs();
        let allowed = a.error_bounds_hz[mode] + b.error_bounds_hz[mode];
        assert!(difference <= allowed, "{mode}: {difference:e} > {allowed:e}");
    }
}

#[test]
fn the_second_solver_agrees() {
    for (file, part, description, elastic) in [
        ("pedestal_10k.msh", "housing", held("feet", [true; 3]), 0),
        ("pedestal_10k.msh", "housing", HousingDescription::default(), 6),
        ("ring3d_hex20.msh", "housing", HousingDescription::default(), 6),
    ] {
        let run = Run::new(file, &[(part, ALUMINIUM)], description);
        let modes = run.modes(ModeRange::Count(20));
        assert_eq!(modes.rigid_modes, elastic, "{file}");
        let hz = &modes.frequencies_hz;
        let top = modes.count_check.below_hz.min(1.001 * hz[19]);
        let band = run.modes(ModeRange::BandHz([0.5 * hz[elastic], top]));
        let inside = hz.iter().filter(|&&hz| hz > 0.0 && hz < top).count();
        assert_eq!(band.count_check.counted, band.count());
        assert!(band.count() >= inside - elastic, "{file}");
        let pairs = band.frequencies_hz.iter().zip(&hz[elastic..]);
        for (place, (there, here)) in pairs.enumerate() {
            let allowed = band.error_bounds_hz[place] + modes.error_bounds_hz[elastic + place];
            let difference = (there - here).abs();
            assert!(difference <= allowed, "{file} {place}: {difference:e} > {allowed:e}");
            // the bounds of both solvers together leave eight digits
            assert!(allowed < 1e-8 * here, "{file} {place}: {allowed:e}");
        }
    }
}

/// 56 000 degrees of freedom: the factor is in single precision.
#[test]
fn threads_change_no_frequency() {
    let run = Run::new("pedestal_60k.msh", &[("housing", ALUMINIUM)], held("feet", [true; 3]));
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| run.modes(ModeRange::Count(20)))
    };
    let (one, two) = (on(1), on(2));
    assert_agree(&one, &two);
    for (a, b) in one.frequencies_hz.iter().zip(&two.frequencies_hz) {
        assert!((a / b - 1.0).abs() < 1e-10, "{a} {b}");
    }
    let again = on(2);
    assert_eq!(two.frequencies_hz, again.frequencies_hz);
    assert!(two.shapes == again.shapes);
    // a coarser Ritz space and other guards: another path to the same values
    let more = run.modes(ModeRange::Count(26));
    for (a, b) in one.frequencies_hz.iter().zip(&more.frequencies_hz) {
        assert!((a / b - 1.0).abs() < 1e-10, "{a} {b}");
    }
}

/// Unknowns in another order get another elimination order, another start vector and another round-off.
#[test]
fn order_and_start_vector_change_no_frequency() {
    let run = Run::new("pedestal_10k.msh", &[("housing", ALUMINIUM)], held("feet", [true; 3]));
    let SystemMatrices { stiffness, mass, .. } = SystemMatrices::assemble(&run.model).unwrap();
    let reference = run.modes(ModeRange::Count(20));
    let mut order = run.model.free_dofs();
    let mut state = 1_u64;
    for shuffle in 0..3 {
        // Fisher and Yates, numbers by Knuth's linear congruence
        for last in (1..order.len()).rev() {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            order.swap(last, (state >> 33) as usize % (last + 1));
        }
        let shuffled = |a| submatrix(a, &order, &order);
        let problem = EigenProblem::new(&shuffled(&stiffness), &shuffled(&mass)).unwrap();
        let found = ModalBasis::of(&problem, ModeRange::Count(20)).unwrap();
        assert_agree(&reference, &found);
        let pairs = reference.frequencies_hz.iter().zip(&found.frequencies_hz);
        let differences = pairs.map(|(a, b)| (a / b - 1.0).abs());
        let largest = differences.fold(0.0, f64::max);
        println!("order {shuffle}: largest relative difference {largest:.1e}");
        assert!(largest < 1e-10, "{largest:e}");
        // another path: not the same numbers to the bit
        assert!(largest > 0.0);
    }
}

#[test]
fn two_floating_parts_and_one() {
    let parts = [("lower", ALUMINIUM), ("upper", ALUMINIUM)];
    for (description, zero) in [(HousingDescription::default(), 12), (held("base", [true; 3]), 6)] {
        let run = Run::new("two_blocks.msh", &parts, description);
        assert_eq!(run.free_motions().total(), zero);
        let sentences = run.free_motions().sentences().join(" ");
        assert!(sentences.contains("not connected"), "{sentences}");
        // fewer, exactly as many, and more than there are
        for count in [4, zero, 20] {
            let modes = run.modes(ModeRange::Count(count));
            assert_eq!(modes.rigid_modes, zero.min(count), "{count} of {zero}");
        }
    }
}

#[test]
fn a_block_that_slides_on_its_base() {
    let parts = [("lower", ALUMINIUM), ("upper", ALUMINIUM)];
    let description = HousingDescription {
        links: vec![Link { between: ["seat".to_owned(), "foot".to_owned()], connection: Connection::Tie }],
        ..held("base", [false, false, true])
    };
    let run = Run::new("two_blocks.msh", &parts, description);
    assert_eq!(run.free_motions().total(), 3);
    assert_eq!(run.modes(ModeRange::Count(10)).rigid_modes, 3);
}

/// Softer supports than any in use are still supports: 1e-9 N/m under 8.3 g is 2e-5 Hz. By the matrices alone a rigid mode
/// has a bound of 0.02 Hz, so that the softest mode on 1e-3 N/m (0.018 Hz) is lost in it.
#[test]
fn soft_springs_are_no_rigid_modes() {
    for (stiffness, by_matrices) in [(1e3, 0), (1.0, 0), (1e-3, 1), (1e-6, 6), (1e-9, 6)] {
        let spring = SpringStiffness::Global([stiffness; 3]);
        let description = HousingDescription {
            supports: vec![HousingSupport {
                group: "feet".to_owned(),
                constraint: Constraint::Spring(spring),
                share: SupportShare::PerGroup,
            }],
            ..HousingDescription::default()
        };
        let run = Run::new("pedestal_10k.msh", &[("housing", ALUMINIUM)], description);
        let modes = run.modes(ModeRange::Count(8));
        let rough = run.by_matrices(ModeRange::Count(8));
        println!(
            "{stiffness:e} N/m: {:.2e} Hz, bound {:.1e} Hz; by the matrices {} rigid, bound {:.1e} Hz",
            modes.frequencies_hz[0], modes.error_bounds_hz[0], rough.rigid_modes, rough.error_bounds_hz[0],
        );
        let found = (modes.rigid_modes, modes.eigenvalues[0] * stiffness.recip());
        // 8.3 g on the springs: the translations have k / m = 120 k, the softest rotation less
        assert_eq!(found.0, 0, "{stiffness}: {:?}", &modes.frequencies_hz);
        assert!(found.1 > 1.0 && found.1 < 150.0, "{stiffness}: {}", found.1);
        assert_eq!(rough.rigid_modes, by_matrices, "{stiffness}");
    }
}

/// Free, of rubber that hardly gives in volume, in two parts, sliding: what is left of zero is far below any support. The
/// limits are thirty times the largest bound found for aluminium, 1.6e-6 Hz; of rubber four times: there the iteration,
/// whose shift follows the bulk modulus, leaves more of elastic shapes in rigid ones, 3e-3 Hz, and says so.
#[test]
fn rigid_modes_have_no_energy() {
    let free = HousingDescription::default;
    let two = [("lower", ALUMINIUM), ("upper", ALUMINIUM)];
    let rubber = [("housing", [1e7, 0.4999, 1100.0])];
    for (file, parts, description, rigid, limit) in [
        ("pedestal_10k.msh", &[("housing", ALUMINIUM)][..], free(), 6, 5e-5),
        ("two_blocks.msh", &two, free(), 12, 5e-5),
        ("two_blocks.msh", &two, held("base", [false, false, true]), 9, 5e-5),
        ("ring3d_hex20.msh", &rubber, free(), 6, 1e-2),
    ] {
        let modes = Run::new(file, parts, description).modes(ModeRange::Count(16));
        assert_eq!(modes.rigid_modes, rigid, "{file}");
        let largest = |values: &[f64]| values[..rigid].iter().fold(0.0_f64, |a, b| a.max(b.abs()));
        let (value, bound) = (largest(&modes.frequencies_hz), largest(&modes.error_bounds_hz));
        println!("{file}: rigid up to {value:.1e} Hz, bound {bound:.1e} Hz");
        assert!(bound < limit && value <= 2.0 * bound, "{file}: {value:e} {bound:e}");
    }
}

/// A million to one: the soft part on a base that is rigid beside it, both ways.
#[test]
fn a_ratio_of_stiffness_of_a_million() {
    let soft = [7e4, 0.33, 2700.0];
    let on_base = |lower: [f64; 3], upper: [f64; 3]| {
        let description = HousingDescription {
            links: vec![Link { between: ["seat".to_owned(), "foot".to_owned()], connection: Connection::Tie }],
            ..held("base", [true; 3])
        };
        let parts = [("lower", lower), ("upper", upper)];
        let modes = Run::new("two_blocks.msh", &parts, description).modes(ModeRange::Count(12));
        assert_eq!(modes.rigid_modes, 0);
        assert!(modes.residuals.iter().all(|&residual| residual < 1e-5));
        modes
    };
    let ratio = on_base(ALUMINIUM, soft);
    // the base rigid: the upper block by itself, held where it stands
    let parts = [("lower", ALUMINIUM), ("upper", soft)];
    let mut alone = held("base", [true; 3]);
    alone.supports.push(HousingSupport {
        group: "foot".to_owned(),
        constraint: Constraint::Fixed([true; 3]),
        share: SupportShare::PerNode,
    });
    let alone = Run::new("two_blocks.msh", &parts, alone).modes(ModeRange::Count(12));
    for (a, b) in ratio.frequencies_hz.iter().zip(&alone.frequencies_hz) {
        // the base gives a millionth
        assert!((a / b - 1.0).abs() < 3e-6, "{a} {b}");
    }
    on_base(soft, ALUMINIUM);
}

/// nu = 0.4999: stiff in volume by 5000 to 1, and all modes there; both solvers agree.
#[test]
fn nearly_incompressible() {
    let rubber = [1e7, 0.4999, 1100.0];
    let run = Run::new("ring3d_hex20.msh", &[("housing", rubber)], HousingDescription::default());
    let modes = run.modes(ModeRange::Count(14));
    assert_eq!(modes.rigid_modes, 6);
    let hz = &modes.frequencies_hz;
    let band = run.modes(ModeRange::BandHz([0.5 * hz[6], modes.count_check.below_hz]));
    for (place, (there, here)) in band.frequencies_hz.iter().zip(&hz[6..]).enumerate() {
        let allowed = band.error_bounds_hz[place] + modes.error_bounds_hz[6 + place];
        assert!((there - here).abs() <= allowed, "{place}");
    }
}

/// Ends of a band on eigenvalues: counted a little above them, which the answer says.
#[test]
fn a_shift_on_an_eigenvalue() {
    let run = Run::new("pedestal_10k.msh", &[("housing", ALUMINIUM)], held("feet", [true; 3]));
    let hz = run.modes(ModeRange::Count(10)).frequencies_hz;
    let band = run.modes(ModeRange::BandHz([hz[2], hz[7]]));
    let check = band.count_check;
    assert_eq!((check.counted, check.found), (band.count(), band.count()));
    // each end may have gone to either side of its eigenvalue
    let (from, to) = (check.above_hz.unwrap(), check.below_hz);
    let expected: Vec<f64> = hz.iter().copied().filter(|&hz| hz > from && hz < to).collect();
    assert_eq!(expected.len(), band.count());
    let up_to = run.modes(ModeRange::UpToHz(hz[7]));
    assert!(up_to.count() == 7 || up_to.count() == 8);
    assert_eq!(run.modes(ModeRange::UpToHz(0.5 * hz[0])).count(), 0);
}

#[test]
fn more_modes_than_the_model_has() {
    let parts = [("lower", ALUMINIUM), ("upper", ALUMINIUM)];
    let run = Run::new("two_blocks.msh", &parts, HousingDescription::default());
    let order = run.problem.order();
    let error = ModalBasis::of(&run.problem, ModeRange::Count(order + 1)).unwrap_err();
    let expected = LinalgError::TooManyModes { asked: order + 1, available: order };
    assert_eq!(error, expected);
}
