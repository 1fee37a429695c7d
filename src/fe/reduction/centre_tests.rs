//! Centre nodes, rigid and mean, in the reduction, against dense computations on the nullspace of W.

use super::interior_basis::coupled_modes;
use super::*;
use crate::fe::assembly::SystemMatrices;
use crate::fe::element::continuum::PlaneAssumption;
use crate::fe::element::curved_beam::RingInterpolation;
use crate::fe::material::{BeamSection, Bond, Material, RingLayer};
use crate::fe::mesh::{
    ElementBlock, ElementId, ElementKind, Entity, Mesh, MeshNotes, MshFormat, MshVersion, PhysicalGroup,
};
use crate::fe::model::{
    CentreNode, CentreTie, Constraint, Fit, HousingDescription, HousingModel, HousingPart, HousingPartition,
    HousingSupport, NodeInterface, PlaneModel, Ring, RingFrame, RingTie, SolidRing, SupportShare,
};
use crate::numerics::linalg::{DenseMatrix, sparse_times_dense, symmetric_eigen, symmetric_generalised_eigen};
use std::path::PathBuf;

/// m: a thick ring whose inner nodes are two bores of a third of the circle each.
const BODY: SolidRing = SolidRing { radius: 20e-3, height: 6e-3, width: 10e-3, around: 6, across: 1, along: 1 };

/// Off the axis and off the plane of symmetry, m.
const LEFT: [f64; 3] = [-5e-3, 1e-3, 2e-3];
const RIGHT: [f64; 3] = [8e-3, -2e-3, -1e-3];

/// Agreement with the dense computation: condition 1e4 of these matrices times round-off, and a margin.
const EXACT: f64 = 1e-9;

struct Scene {
    mesh: Mesh,
    model: HousingModel,
    matrices: SystemMatrices,
}

impl Scene {
    /// The ring in space or in the plane, free, or held by a node of its outside ("foot").
    fn new(dimension: usize, held: bool) -> Self {
        let empty = Mesh {
            nodes: Vec::new(),
            node_tags: Vec::new(),
            blocks: Vec::new(),
            groups: Vec::new(),
            format: MshFormat { version: MshVersion::V41, binary: false },
            notes: MeshNotes::default(),
            source: PathBuf::from("centres"),
        };
        let meshed = BODY.added_to(&empty, &RingFrame::default(), dimension);
        let mut mesh = meshed.mesh;
        let inner = |[x, y, _]: [f64; 3]| x.hypot(y) < 17.1e-3;
        let outer = |[x, y, _]: [f64; 3]| x.hypot(y) > 22.9e-3;
        add_points(&mut mesh, "left", |x| inner(x) && x[0] < -9e-3);
        add_points(&mut mesh, "right", |x| inner(x) && x[0] > 9e-3);
        add_points(&mut mesh, "inside", inner);
        add_points(&mut mesh, "foot", |x| outer(x) && x[1] < -22.9e-3);
        add_points(&mut mesh, "probe", |x| outer(x) && x[0] > 22.9e-3);
        add_points(&mut mesh, "top", |x| outer(x) && x[1] > 15e-3);
        let material = Material::new(70e9, 0.33, 2700.0).expect("a material");
        let foot = HousingSupport {
            group: "foot".to_owned(),
            constraint: Constraint::Fixed([true; 3]),
            share: SupportShare::PerNode,
        };
        let description = HousingDescription {
            parts: vec![HousingPart { group: meshed.body, material: material.into() }],
            plane: (dimension == 2).then_some(PlaneModel { assumption: PlaneAssumption::Stress, thickness: 10e-3 }),
            supports: if held { vec![foot] } else { Vec::new() },
            ..HousingDescription::default()
        };
        let model = HousingModel::new(&mesh, description).expect("a model");
        let matrices = SystemMatrices::assemble(&model).expect("matrices");
        Self { mesh, model, matrices }
    }

    fn centre(&self, group: &str, point: [f64; 3], tie: CentreTie) -> CentreNode {
        CentreNode::new(&self.mesh, &self.model, group, point, tie).expect("a centre node")
    }

    /// The left bore in the mean, the right one rigid.
    fn both(&self) -> HousingPartition {
        let (left, right) = (self.centre("left", LEFT, CentreTie::Mean), self.centre("right", RIGHT, CentreTie::Rigid));
        self.joined(&[("left", left.partition()), ("right", right.partition())])
    }

    fn joined(&self, parts: &[(&str, &HousingPartition)]) -> HousingPartition {
        HousingPartition::joined(&self.model, parts).expect("apart")
    }

    /// Displacements of all free degrees of freedom [dof x 6 (3)] in rigid motions about the origin, and what a centre does.
    fn rigid(&self, centres: &[&CentreNode]) -> RigidMotions {
        let (d, dof) = (self.model.dimension(), self.model.dof());
        let units: Vec<[[f64; 3]; 2]> = match d {
            3 => (0..6)
                .map(|k| [0, 3].map(|first| std::array::from_fn(|i| f64::from(u8::from(first + i == k)))))
                .collect(),
            _ => vec![[[1.0, 0.0, 0.0], [0.0; 3]], [[0.0, 1.0, 0.0], [0.0; 3]], [[0.0; 3], [0.0, 0.0, 1.0]]],
        };
        let moves = |[u, [a, b, c]]: [[f64; 3]; 2], [x, y, z]: [f64; 3]| {
            [u[0] + b * z - c * y, u[1] + c * x - a * z, u[2] + a * y - b * x]
        };
        let housing = DenseMatrix::from_fn(dof, units.len(), |row, motion| {
            moves(units[motion], self.model.coordinates()[row / d])[row % d]
        });
        let columns: Vec<Vec<f64>> =
            units.iter().map(|&[u, turn]| centres.iter().flat_map(|c| c.rigid_motion(u, turn)).collect()).collect();
        let interface = DenseMatrix::from_fn(columns[0].len(), units.len(), |row, motion| columns[motion][row]);
        RigidMotions { housing, interface }
    }
}

fn add_points(mesh: &mut Mesh, name: &str, holds: impl Fn([f64; 3]) -> bool) {
    let nodes: Vec<usize> = (0..mesh.nodes.len()).filter(|&node| holds(mesh.nodes[node])).collect();
    let (block, tag) = (mesh.blocks.len(), 100 + mesh.groups.len() as i32);
    mesh.blocks.push(ElementBlock {
        kind: ElementKind::Point,
        tags: (0..nodes.len() as u64).map(|k| 1000 * tag as u64 + k).collect(),
        connectivity: nodes.clone(),
        entity: Entity { dimension: 0, tag },
    });
    let elements = (0..nodes.len()).map(|index| ElementId { block, index }).collect();
    mesh.groups.push(PhysicalGroup { name: name.to_owned(), dimension: 0, tag, nodes, elements });
}

/// What the reduction should give, by dense matrices alone.
struct Dense {
    /// Static modes over interior and driven [dof x interface].
    modes: DenseMatrix,
    /// Fixed-interface eigenvalues.
    values: Vec<f64>,
    /// `V^T K V` and `V^T M V` of all motions V = (static modes, nullspace of W).
    whole: [DenseMatrix; 2],
    /// Sums of the magnitudes of the terms of the stiffness of each static mode: what round-off is relative to.
    terms: Vec<f64>,
}

fn dense(matrices: &SystemMatrices, partition: &HousingPartition) -> Dense {
    let dof = matrices.stiffness.rows();
    let full = |a| sparse_times_dense(a, &DenseMatrix::identity(dof, dof));
    let [k, m] = [full(&matrices.stiffness), full(&matrices.mass)];
    let interface = partition.tie.cols();
    let mean = &partition.mean;
    // W over the interior, orthonormal complement by the eigenvectors of W^T W
    let w = DenseMatrix::from_fn(mean.coordinates.len(), partition.interior.len(), |row, column| {
        mean.weights.get(partition.interior[column], row).copied().unwrap_or(0.0)
    });
    let p = w.nrows();
    let lengths: Vec<f64> = (0..p).map(|row| w.row(row).norm_l2()).collect();
    let unit = DenseMatrix::from_fn(p, w.ncols(), |row, column| w[(row, column)] / lengths[row]);
    let spectrum = symmetric_eigen(&(unit.transpose() * &unit)).expect("symmetric");
    let null = spectrum.vectors.subcols(0, w.ncols() - p).to_owned();
    let place = |inside: &DenseMatrix, driven: &DenseMatrix| {
        let mut all = DenseMatrix::zeros(dof, inside.ncols());
        for column in 0..inside.ncols() {
            for (row, &at) in partition.interior.iter().enumerate() {
                all[(at, column)] = inside[(row, column)];
            }
            for (row, &at) in partition.driven.iter().enumerate() {
                all[(at, column)] = driven[(row, column)];
            }
        }
        all
    };
    // any motion with the right interface: W^T (W W^T)^-1 C inside, T outside
    let chosen = DenseMatrix::from_fn(p, interface, |row, column| {
        f64::from(u8::from(mean.coordinates[row] == column)) / lengths[row]
    });
    let some = if p == 0 {
        DenseMatrix::zeros(w.ncols(), interface)
    } else {
        unit.transpose()
            * crate::numerics::linalg::DenseCholesky::new(&(&unit * unit.transpose())).expect("apart").solve(&chosen)
    };
    let driven = sparse_times_dense(&partition.tie, &DenseMatrix::identity(interface, interface));
    let some = place(&some, &driven);
    let free = place(&null, &DenseMatrix::zeros(partition.driven.len(), null.ncols()));
    let [k_ff, m_ff] = [&k, &m].map(|a| free.transpose() * (a * &free));
    let pulled = free.transpose() * (&k * &some);
    let held = crate::numerics::linalg::DenseCholesky::new(&k_ff).expect("held").solve(&pulled);
    let modes = some - &free * held;
    let values = symmetric_generalised_eigen(&k_ff, &m_ff).expect("definite").values;
    let all = faer::concat![[modes, free]];
    let whole = [&k, &m].map(|a| all.transpose() * (a * &all));
    let size = |a: &DenseMatrix| DenseMatrix::from_fn(a.nrows(), a.ncols(), |row, column| a[(row, column)].abs());
    let sizes = size(&modes).transpose() * (size(&k) * size(&modes));
    let terms = (0..interface).map(|column| sizes[(column, column)]).collect();
    Dense { modes, values, whole, terms }
}

fn condensed(scene: &Scene, partition: &HousingPartition, size: BasisSize, enhanced: bool) -> CraigBampton {
    let choice = BasisChoice { size, enhanced, band_hz: 20e3 };
    craig_bampton(&scene.matrices, partition, choice, None).expect("connected")
}

fn near(found: &[f64], expected: &[f64], tolerance: f64) {
    let largest = expected.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
    for (found, expected) in found.iter().zip(expected) {
        let error = (found - expected).abs();
        assert!(error <= tolerance * expected.abs().max(1e-6 * largest), "{found} {expected}");
    }
}

/// Static modes, their stiffness and mass, and the fixed-interface modes: one mean centre on a free body, one on a body that is
/// held, a mean and a rigid one together, and two means.
#[test]
fn static_and_fixed_interface_modes_are_those_of_the_nullspace() {
    for (dimension, held) in [(3, false), (3, true), (2, false)] {
        let scene = Scene::new(dimension, held);
        let mean = scene.centre("left", LEFT, CentreTie::Mean);
        let other = scene.centre("right", RIGHT, CentreTie::Mean);
        assert_eq!(mean.coordinates().last(), Some(&5));
        assert_eq!(mean.coordinates().len(), mean.partition().tie.cols());
        let two = scene.joined(&[("left", mean.partition()), ("right", other.partition())]);
        for partition in [mean.partition(), &scene.both(), &two] {
            let expected = dense(&scene.matrices, partition);
            let substructure = Substructure::new(&scene.matrices, partition).expect("held");
            let psi = &substructure.constraint_modes;
            for (row, &dof) in partition.interior.iter().enumerate() {
                for column in 0..psi.ncols() {
                    let error = (psi[(row, column)] - expected.modes[(dof, column)]).abs();
                    // displacements by rotations are lengths
                    assert!(error < EXACT * expected.modes.col(column).norm_max(), "{dof} {column}: {error:e}");
                }
            }
            let count = psi.ncols();
            for (found, whole) in
                [(substructure.stiffness(), &expected.whole[0]), (&substructure.mass, &expected.whole[1])]
            {
                let all = &whole;
                let stiffest = (0..count).map(|k| expected.terms[k].sqrt()).collect::<Vec<f64>>();
                let scale =
                    |k: usize| if std::ptr::eq(*all, &expected.whole[0]) { stiffest[k] } else { all[(k, k)].sqrt() };
                for row in 0..count {
                    for column in 0..count {
                        // the stiffness of a free body at one centre is zero
                        let scale = scale(row) * scale(column);
                        let error = (found[(row, column)] - whole[(row, column)]).abs();
                        assert!(error <= EXACT * scale, "{row} {column}: {error:e} of {scale:e}");
                    }
                }
            }
            let pairs = substructure.lowest_modes(10).expect("found");
            near(&pairs.values, &expected.values[..10], EXACT);
            let all = substructure.interior_dof();
            assert_eq!(all, expected.values.len());
            // the vectors keep the mean where it is
            for (&coordinate, weights) in partition.mean.coordinates.iter().zip(partition.mean.weights.outer_iterator())
            {
                for mode in 0..10 {
                    let of =
                        |dof: usize| partition.interior.binary_search(&dof).map_or(0.0, |at| pairs.vectors[(at, mode)]);
                    let terms: Vec<f64> = weights.iter().map(|(dof, weight)| weight * of(dof)).collect();
                    let size: f64 = terms.iter().map(|term| term.abs()).sum();
                    assert!(terms.iter().sum::<f64>().abs() <= 1e-12 * size, "{coordinate} {mode}");
                }
            }
        }
    }
}

/// With every vector of the interior a mean centre changes nothing: the modes are those of the free housing. A rigid one
/// stiffens it.
#[test]
fn a_mean_centre_leaves_the_housing_as_it_is_and_a_rigid_one_stiffens_it() {
    for dimension in [2, 3] {
        let scene = Scene::new(dimension, false);
        let rigid_modes = if dimension == 3 { 6 } else { 3 };
        let dof = scene.matrices.stiffness.rows();
        let full = |a| sparse_times_dense(a, &DenseMatrix::identity(dof, dof));
        let all = symmetric_generalised_eigen(&full(&scene.matrices.stiffness), &full(&scene.matrices.mass));
        let all = all.expect("definite").values;
        let modes = |tie: CentreTie| {
            let centre = scene.centre("left", LEFT, tie);
            let condensed = condensed(&scene, centre.partition(), BasisSize::Count(dof), false);
            coupled_modes(&condensed.substructure, &condensed.basis, None).expect("definite").values
        };
        let [mean, rigid] = [CentreTie::Mean, CentreTie::Rigid].map(modes);
        assert_eq!(mean.len(), all.len());
        near(&mean[rigid_modes..rigid_modes + 20], &all[rigid_modes..rigid_modes + 20], EXACT);
        // rows of fewer unknowns: eigenvalues interlace from above (Rayleigh), and the first elastic one is stiffer by far
        for (mode, (rigid, mean)) in rigid.iter().zip(&mean).enumerate().skip(rigid_modes) {
            assert!(*rigid >= mean * (1.0 - EXACT), "{mode}");
        }
        assert!(rigid[rigid_modes] > 1.05 * mean[rigid_modes], "{} {}", rigid[rigid_modes], mean[rigid_modes]);
    }
}

/// `|K r| <= 1e-9 |K|`, and `r^T M r` is the mass of the rigid body: total mass, centroid, inertia.
#[test]
fn rigid_motions_at_centres_cost_nothing_and_weigh_the_body() {
    for dimension in [2, 3] {
        let scene = Scene::new(dimension, false);
        for ties in [[CentreTie::Mean, CentreTie::Rigid], [CentreTie::Mean; 2], [CentreTie::Rigid; 2]] {
            let centres = [scene.centre("left", LEFT, ties[0]), scene.centre("right", RIGHT, ties[1])];
            let both = scene.joined(&[("left", centres[0].partition()), ("right", centres[1].partition())]);
            let substructure = Substructure::new(&scene.matrices, &both).expect("held");
            let motions = scene.rigid(&[&centres[0], &centres[1]]);
            let force = substructure.stiffness() * &motions.interface;
            assert!(
                force.norm_max() <= EXACT * substructure.stiffness().norm_max(),
                "{ties:?}: {:e}",
                force.norm_max()
            );
            let mass = motions.interface.transpose() * &substructure.mass * &motions.interface;
            let body = motions.housing.transpose() * sparse_times_dense(&scene.matrices.mass, &motions.housing);
            for row in 0..mass.nrows() {
                for column in 0..mass.ncols() {
                    let scale = (body[(row, row)] * body[(column, column)]).sqrt();
                    let error = (mass[(row, column)] - body[(row, column)]).abs();
                    assert!(error <= EXACT * scale, "{ties:?} {row} {column}: {error:e} of {scale:e}");
                }
            }
        }
    }
}

/// Ring, mean centre, rigid centre and a plain node in one interface: all checks pass, the whole basis gives the modes of the
/// dense matrices, recovery rows are those of the field, and the estimate is the error.
#[test]
fn interfaces_of_all_kinds_stand_in_one() {
    let scene = Scene::new(3, false);
    let (left, right) = (scene.centre("left", LEFT, CentreTie::Mean), scene.centre("right", RIGHT, CentreTie::Rigid));
    let ring = ring(1.0);
    let tie = RingTie::new(&scene.mesh, &scene.model, "top", &ring, None, Fit::Bonded).expect("a tie");
    let probe = NodeInterface::new(&scene.model, &scene.mesh.group("probe").expect("a group").nodes);
    let partition = scene.joined(&[
        ("ring", tie.partition()),
        ("left", left.partition()),
        ("probe", &probe.partition),
        ("right", right.partition()),
    ]);
    // an arc of the ring is all that the housing stiffens: the rest of its coordinates is idle without the ring itself
    let count = partition.tie.cols();
    let part = |a: &DenseMatrix| {
        DenseMatrix::from_fn(
            count,
            count,
            |row, column| if row.max(column) < ring.dof() { a[(row, column)] } else { 0.0 },
        )
    };
    let [k, m] = [part(ring.stiffness()), part(ring.mass())];
    let attached = Some(Attached { stiffness: &k, mass: &m });
    let expected = dense(&scene.matrices, &partition);
    let [mut whole_k, mut whole_m] = expected.whole.clone();
    for row in 0..count {
        for column in 0..count {
            whole_k[(row, column)] += k[(row, column)];
            whole_m[(row, column)] += m[(row, column)];
        }
    }
    let exact = symmetric_generalised_eigen(&whole_k, &whole_m).expect("definite").values;
    let choice = |size, enhanced| BasisChoice { size, enhanced, band_hz: 20e3 };
    let of = |size, enhanced| {
        let done = craig_bampton(&scene.matrices, &partition, choice(size, enhanced), attached).expect("connected");
        let modes = coupled_modes(&done.substructure, &done.basis, attached).expect("definite");
        (done, modes.values)
    };
    let (all, values) = of(BasisSize::Count(usize::MAX), false);
    near(&values[6..26], &exact[6..26], EXACT);
    let error = |values: &[f64], band: usize| {
        let errors = values.iter().zip(&exact).take(band).skip(6).map(|(found, exact)| (found / exact).sqrt() - 1.0);
        errors.fold(0.0, f64::max)
    };
    let band = exact.partition_point(|value| value.sqrt() <= std::f64::consts::TAU * 20e3);
    assert!(band > 8, "{band} modes in the band");
    let (plain, values) = of(BasisSize::Count(6), false);
    let estimate = ErrorEstimate::of(&plain.substructure, &plain.basis, attached, 20e3).expect("finite");
    let (estimated, was) = (estimate.largest(), error(&values, band));
    // the estimate's remainder is extrapolated
    assert!((estimated / was - 1.0).abs() < 0.25, "{estimated:e} {was:e}");
    let (enhanced, values) = of(BasisSize::Auto(1e-4), true);
    assert!(error(&values, band) <= 1e-4 && enhanced.basis.residual_vectors > 0);
    // data recovery
    let order = enhanced.superelement.order();
    let unit = DenseMatrix::identity(order, order);
    let field = enhanced.field(&unit, scene.model.dof());
    for dof in scene.model.free_dofs() {
        let row = enhanced.recovery_row(dof).expect("not fixed");
        for (column, &value) in row.iter().enumerate() {
            assert!((field[(dof, column)] - value).abs() <= 1e-15 * field.norm_max(), "{dof} {column}");
        }
    }
    // the field's mean is the coordinate
    for (&coordinate, weights) in partition.mean.coordinates.iter().zip(partition.mean.weights.outer_iterator()) {
        for column in 0..order {
            let mean: f64 = weights.iter().map(|(dof, weight)| weight * field[(dof, column)]).sum();
            let size: f64 = weights.iter().map(|(dof, weight)| (weight * field[(dof, column)]).abs()).sum();
            let expected = f64::from(u8::from(coordinate == column));
            assert!((mean - expected).abs() <= 1e-10 * size.max(1.0), "{coordinate} {column}: {mean}");
        }
    }
    // only checks of the housing alone: without the ring its idle coordinates have no mass
    let centres = scene.both();
    let motions = scene.rigid(&[&left, &right]);
    let alone = condensed(&scene, &centres, BasisSize::UpTo(40e3), true);
    for check in check_craig_bampton(&alone, None, &scene.matrices, &motions, 20e3).expect("finite") {
        assert!(check.ok(), "{check:?}");
    }
    assert!(all.basis.count() > enhanced.basis.count());
}

/// A free body on one node has no stiffness there but round-off. Its checks pass, and fail by a wrong entry of a millionth of what
/// the stiffness is made of.
#[test]
fn a_free_body_on_one_centre_passes_its_checks() {
    let scene = Scene::new(3, false);
    for tie in [CentreTie::Mean, CentreTie::Rigid] {
        let centre = scene.centre("left", LEFT, tie);
        let motions = scene.rigid(&[&centre]);
        let failed = |condensed: &CraigBampton| -> Vec<&str> {
            let checks = check_craig_bampton(condensed, None, &scene.matrices, &motions, 20e3).expect("finite");
            checks.iter().filter(|check| !check.ok()).map(|check| check.name).collect()
        };
        let right = condensed(&scene, centre.partition(), BasisSize::UpTo(40e3), false);
        assert_eq!(failed(&right), [""; 0], "{tie:?}");
        let alone = check_matrices(&right.superelement, None).expect("finite");
        assert!(alone.iter().all(Check::ok), "{alone:?}");
        let wrong = |share: f64| {
            let mut wrong = right.clone();
            wrong.superelement.stiffness[(1, 1)] += share * wrong.substructure.made_of[1];
            failed(&wrong)
        };
        assert!(wrong(1e-6).contains(&"rigid energy"), "{:?}", wrong(1e-6));
        assert!(wrong(-1e-6).contains(&"stiffness semidefinite"), "{:?}", wrong(-1e-6));
        let mut wrong = right.clone();
        wrong.substructure.constraint_modes[(40, 1)] += 1e-6;
        assert!(failed(&wrong).contains(&"constraint modes orthogonal"), "{:?}", failed(&wrong));
        // round-off is no stiffness: without amplitudes nothing else would be left, of either sign
        let alone = condensed(&scene, centre.partition(), BasisSize::Count(0), false);
        let modes = coupled_modes(&alone.substructure, &alone.basis, None).expect("rigid modes");
        assert!(modes.values.iter().all(|value| value.abs() < 1e-12), "{tie:?}: {:?}", modes.values);
    }
}

/// Checks fire where a mean is not kept: vectors or static modes that move it.
#[test]
fn a_static_mode_that_is_none_fails_its_check() {
    let scene = Scene::new(3, false);
    let (left, right) = (scene.centre("left", LEFT, CentreTie::Mean), scene.centre("right", RIGHT, CentreTie::Rigid));
    let mut condensed = condensed(&scene, &scene.both(), BasisSize::UpTo(40e3), false);
    condensed.substructure.constraint_modes[(40, 1)] += 1e-6;
    let motions = scene.rigid(&[&left, &right]);
    let checks = check_craig_bampton(&condensed, None, &scene.matrices, &motions, 20e3).expect("finite");
    let failed: Vec<&str> = checks.iter().filter(|check| !check.ok()).map(|check| check.name).collect();
    assert!(failed.contains(&"static interior"), "{failed:?}");
}

/// Ring of radius 16 mm and a section of 2 x 2 mm, so many times as stiff as aluminium and with next to no mass.
fn ring(stiffer: f64) -> Ring {
    let layer = RingLayer {
        material: Material::new(stiffer * 70e9, 0.33, 1e-3).expect("a material"),
        area: 4e-6,
        inertia: 4.0 / 3.0 * 1e-12,
        axial_inertia: None,
        torsion: None,
        radius: 16e-3,
        shear_coefficient: 5.0 / 6.0,
    };
    let section = BeamSection::combine(&[layer], Bond::Composite).expect("a section");
    Ring::in_space(12, section, RingInterpolation::default()).expect("a ring")
}

/// A ring that cannot deform ties as a rigid centre does: the difference goes with its flexibility.
#[test]
fn a_rigid_centre_is_a_ring_of_infinite_stiffness() {
    let scene = Scene::new(3, false);
    let rigid = scene.centre("inside", LEFT, CentreTie::Rigid);
    let lowest = |partition: &HousingPartition, ring: Option<&Ring>| {
        let attached = ring.map(|ring| Attached { stiffness: ring.stiffness(), mass: ring.mass() });
        let choice = BasisChoice { size: BasisSize::Count(60), enhanced: false, band_hz: 20e3 };
        let done = craig_bampton(&scene.matrices, partition, choice, attached).expect("connected");
        coupled_modes(&done.substructure, &done.basis, attached).expect("definite").values[6].sqrt()
    };
    let limit = lowest(rigid.partition(), None);
    let errors = [1e6, 1e7, 1e8].map(|stiffer| {
        let ring = ring(stiffer);
        let tie = RingTie::new(&scene.mesh, &scene.model, "inside", &ring, None, Fit::Bonded).expect("a tie");
        1.0 - lowest(tie.partition(), Some(&ring)) / limit
    });
    assert!(errors[0] > 0.0 && errors[2] < 1e-3, "{errors:?}");
    // ten times as stiff, a tenth of the error, to first order
    for pair in errors.windows(2) {
        assert!((pair[0] / pair[1] / 10.0 - 1.0).abs() < 0.2, "{errors:?}");
    }
}

/// Structural damping and weight of a mean centre: `V^T A V` by the field itself.
#[test]
fn weight_and_losses_follow_the_field() {
    let scene = Scene::new(3, true);
    let element =
        condensed(&scene, &scene.both(), BasisSize::Count(8), true).with_structural(&scene.matrices.stiffness);
    let order = element.superelement.order();
    let field = element.field(&DenseMatrix::identity(order, order), scene.model.dof());
    let losses = field.transpose() * sparse_times_dense(&scene.matrices.stiffness, &field);
    let found = element.superelement.structural.as_ref().expect("lossy");
    assert!((found - &losses).norm_max() <= 1e-9 * losses.norm_max());
    // a loss factor of 1 for all parts is the stiffness itself
    assert!((found - &element.superelement.stiffness).norm_max() <= 1e-9 * losses.norm_max());
    let mut weight = scene.matrices.weight.clone();
    for (node, fixed) in scene.model.coordinates().iter().enumerate() {
        if fixed[1] < -22.9e-3 {
            (0..3).for_each(|k| (0..2).for_each(|axis| weight[(3 * node + k, axis)] = 0.0));
        }
    }
    let expected = field.transpose() * &weight;
    assert!((&element.superelement.weight - &expected).norm_max() <= 1e-9 * expected.norm_max());
}
