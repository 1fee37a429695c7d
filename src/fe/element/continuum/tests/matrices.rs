//! What every stiffness and mass matrix must satisfy, alone.

use nalgebra::DMatrix;

use super::Outcome;
use super::fixtures::{
    POISSON, SHEAR, YOUNG, all_properties, aluminium, curved, distorted, elements, field, laminate, laminate_along,
    properties, rigid_motions, straight, very_fine,
};
use crate::fe::element::ElementError;
use crate::fe::element::continuum::geometry::Placed;
use crate::fe::element::continuum::table::Table;
use crate::fe::element::continuum::table::for_kind;
use crate::fe::element::continuum::{ContinuumProperties, Formulation, mass, measure, stiffness};
use crate::fe::material::{ElasticMaterial, OrthotropicMaterial};
use crate::fe::mesh::ElementKind;

pub(super) fn check(kind: ElementKind, formulation: Formulation) -> Outcome {
    for p in all_properties(kind)? {
        for coords in elements(kind) {
            symmetry(kind, &coords, &p, formulation)?;
            rigid_motions_and_no_other_mechanism(kind, &coords, &p, formulation)?;
            mass_is_density_times_volume(kind, &coords, &p, formulation)?;
            mass_is_exact(kind, &coords, &p)?;
        }
        inertia_about_the_axes(kind, &p, formulation)?;
    }
    for orthotropic in [false, true] {
        uniform_strain_energy(kind, formulation, orthotropic)?;
        rotation(kind, formulation, orthotropic)?;
    }
    Ok(())
}

fn symmetry(
    kind: ElementKind,
    coords: &[[f64; 3]],
    p: &ContinuumProperties,
    formulation: Formulation,
) -> Result<(), ElementError> {
    let k = stiffness(kind, coords, p, formulation)?;
    assert_eq!(k.shape(), (kind.dof(), kind.dof()));
    assert_eq!(k, k.transpose(), "{kind:?}");
    let m = mass(kind, coords, p, formulation)?;
    assert_eq!(m.shape(), (kind.dof(), kind.dof()));
    assert!((&m - m.transpose()).amax() <= 1e-16 * m.amax(), "{kind:?}");
    Ok(())
}

/// A force is a sum of up to 60 products, each of at most the largest entry times the largest displacement and
/// rounded to 1e-16 of it: 1e-14 of both. The smallest elastic eigenvalue is that of the shape, 1e-4 of the
/// largest at worst here.
fn rigid_motions_and_no_other_mechanism(
    kind: ElementKind,
    coords: &[[f64; 3]],
    p: &ContinuumProperties,
    formulation: Formulation,
) -> Result<(), ElementError> {
    let k = stiffness(kind, coords, p, formulation)?;
    let motions = rigid_motions(kind, coords);
    for motion in &motions {
        let force = (&k * motion).amax() / (k.amax() * motion.amax());
        assert!(force <= 1e-14, "{kind:?}: {force:e}");
    }
    let mut values: Vec<f64> = k.symmetric_eigenvalues().iter().copied().collect();
    values.sort_by(f64::total_cmp);
    let largest = values[values.len() - 1];
    let elastic = values[motions.len()] / largest;
    assert!(elastic > 1e-4, "{kind:?} has a mechanism: {elastic:e}");
    Ok(())
}

/// The mass met by a translation, and no motion without mass.
fn mass_is_density_times_volume(
    kind: ElementKind,
    coords: &[[f64; 3]],
    p: &ContinuumProperties,
    formulation: Formulation,
) -> Result<(), ElementError> {
    let m = mass(kind, coords, p, formulation)?;
    let expected = p.density * p.thickness * measure(kind, coords)?;
    for d in 0..kind.dimension() {
        let translation = field(kind, coords, |_| [0, 1, 2].map(|i| f64::from(u8::from(i == d))));
        let found = translation.dot(&(&m * &translation));
        assert!((found / expected - 1.0).abs() < 1e-14, "{kind:?}: {found} {expected}");
    }
    let smallest = m.symmetric_eigenvalues().min();
    assert!(smallest > 0.0, "{kind:?}: mass eigenvalue {smallest}");
    Ok(())
}

/// Against 12 points a direction, on straight, distorted and curved elements.
fn mass_is_exact(kind: ElementKind, coords: &[[f64; 3]], p: &ContinuumProperties) -> Result<(), ElementError> {
    let fine = fine_mass(kind, coords, p)?;
    let fine = fine.kronecker(&DMatrix::identity(kind.dimension(), kind.dimension()));
    let error = (mass(kind, coords, p, super::PLAIN)? - &fine).amax() / fine.amax();
    assert!(error < 1e-14, "{kind:?}: {error:e}");
    Ok(())
}

fn fine_mass(kind: ElementKind, coords: &[[f64; 3]], p: &ContinuumProperties) -> Result<DMatrix<f64>, ElementError> {
    fn integrate<const N: usize, const D: usize>(
        kind: ElementKind,
        coords: &[[f64; 3]],
        density: f64,
        out: &mut [f64],
    ) -> Result<(), ElementError> {
        let placed = Placed::<N>::new(kind, coords)?;
        let table = Table::new(kind, &very_fine(kind));
        crate::fe::element::continuum::mass::integrate::<N, D>(kind, coords, &placed, density, &table, out)
    }
    let mut out = DMatrix::zeros(kind.nodes(), kind.nodes());
    let density = p.density * p.thickness;
    for_kind!(kind, integrate(kind, coords, density, out.as_mut_slice()))?;
    Ok(out)
}

/// The straight element as simplices, by corners.
fn simplices(kind: ElementKind) -> &'static [&'static [usize]] {
    match kind.name().trim_end_matches(char::is_numeric) {
        "Tri" => &[&[0, 1, 2]],
        "Quad" => &[&[0, 1, 2], &[0, 2, 3]],
        "Tet" => &[&[0, 1, 2, 3]],
        "Pyramid" => &[&[0, 1, 2, 4], &[0, 2, 3, 4]],
        "Wedge" => &[&[0, 1, 2, 5], &[0, 1, 5, 4], &[0, 4, 5, 3]],
        _ => &[&[0, 1, 2, 6], &[0, 2, 3, 6], &[0, 3, 7, 6], &[0, 7, 4, 6], &[0, 4, 5, 6], &[0, 5, 1, 6]],
    }
}

/// Measure of a simplex from the determinant of its edges.
fn simplex_measure(x: &[[f64; 3]]) -> f64 {
    let edge = |i: usize| [0, 1, 2].map(|d| x[i][d] - x[0][d]);
    let (a, b) = (edge(1), edge(2));
    let z = a[0] * b[1] - a[1] * b[0];
    if x.len() == 3 {
        return z / 2.0;
    }
    let c = edge(3);
    ((a[1] * b[2] - a[2] * b[1]) * c[0] + (a[2] * b[0] - a[0] * b[2]) * c[1] + z * c[2]) / 6.0
}

/// A rotation meets `rho int |w x r|^2 dV`, by hand. Over a simplex with n
/// corners `int x_i x_j dV = V / (n (n + 1)) (sum_a x_ai x_aj + sum_a x_ai sum_a x_aj)`.
fn inertia_about_the_axes(
    kind: ElementKind,
    p: &ContinuumProperties,
    formulation: Formulation,
) -> Result<(), ElementError> {
    let coords = straight(kind);
    let mut moments = [0.0; 3];
    let mut volume = 0.0;
    for simplex in simplices(kind) {
        let x: Vec<[f64; 3]> = simplex.iter().map(|&corner| coords[corner]).collect();
        let size = simplex_measure(&x);
        assert!(size > 0.0);
        volume += size;
        let n = x.len() as f64;
        for (d, moment) in moments.iter_mut().enumerate() {
            let squares: f64 = x.iter().map(|node| node[d] * node[d]).sum();
            let sum: f64 = x.iter().map(|node| node[d]).sum();
            *moment += size / (n * (n + 1.0)) * (squares + sum * sum);
        }
    }
    assert!((measure(kind, &coords)? / volume - 1.0).abs() < 1e-14);
    let m = mass(kind, &coords, p, formulation)?;
    let [x, y, z] = moments;
    let motions = rigid_motions(kind, &coords);
    for (which, second) in [(2, x + y), (4, y + z), (5, x + z)] {
        let Some(motion) = motions.get(which) else {
            continue;
        };
        let found = motion.dot(&(&m * motion));
        let expected = p.density * p.thickness * second;
        assert!((found / expected - 1.0).abs() < 1e-14, "{kind:?}: {found} {expected}");
    }
    Ok(())
}

/// Energy of uniform strains, by hand from the definition of the constants: strains under given stresses in
/// material axes, `1/2 sigma . eps V`. On every shape: the volume is integrated exactly, but for the four-point
/// rule on curved Tet10.
fn uniform_strain_energy(kind: ElementKind, formulation: Formulation, orthotropic: bool) -> Outcome {
    let (material, young, poisson, shear, axes) = if orthotropic {
        let material = laminate(kind)?;
        let ElasticMaterial::Orthotropic(constants) = material else {
            return Err("not orthotropic".into());
        };
        (material, YOUNG, POISSON, SHEAR, constants.axes)
    } else {
        let identity = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let g = 70e9 / 2.66;
        (aluminium()?, [70e9; 3], [0.33; 3], [g; 3], identity)
    };
    let exact = formulation != super::FOUR_POINT;
    let shapes = elements(kind);
    let shapes = if exact { &shapes[..] } else { &shapes[..2] };
    for (which, p) in properties(kind, &material)?.iter().enumerate() {
        for coords in shapes {
            let k = stiffness(kind, coords, p, formulation)?;
            let volume = p.thickness * measure(kind, coords)?;
            for stress in [[3.0, 0.0], [0.0, 2.0], [1.0, -1.5]] {
                for slip in [0.0, 0.7] {
                    let [x, y] = stress;
                    let plane_strain = poisson[2] * young[2] / young[0] * x + poisson[1] * young[2] / young[1] * y;
                    let z = match (kind.dimension(), which) {
                        (2, 0) => 0.0,
                        (2, _) => plane_strain,
                        _ => 0.8,
                    };
                    let out_of_plane = if kind.dimension() == 3 { slip } else { 0.0 };
                    let sigma = [x, y, z, slip, 0.5 * out_of_plane, -out_of_plane].map(|s| 1e6 * s);
                    let eps = strain(young, poisson, shear, sigma);
                    let energy = 0.5 * sigma.iter().zip(eps).map(|(s, e)| s * e).sum::<f64>();
                    let u = field(kind, coords, |x| displacement(axes, eps, x));
                    let found = 0.5 * u.dot(&(&k * &u)) / (energy * volume);
                    assert!((found - 1.0).abs() < 1e-12, "{kind:?} {sigma:?}: {found}");
                }
            }
        }
    }
    Ok(())
}

/// Strains (engineering shear) under stresses, both in material axes.
fn strain(e: [f64; 3], nu: [f64; 3], g: [f64; 3], s: [f64; 6]) -> [f64; 6] {
    [
        s[0] / e[0] - nu[0] / e[0] * s[1] - nu[2] / e[0] * s[2],
        s[1] / e[1] - nu[0] / e[0] * s[0] - nu[1] / e[1] * s[2],
        s[2] / e[2] - nu[2] / e[0] * s[0] - nu[1] / e[1] * s[1],
        s[3] / g[0],
        s[4] / g[1],
        s[5] / g[2],
    ]
}

/// A displacement with uniform strains given in the axes.
fn displacement(axes: [[f64; 3]; 3], eps: [f64; 6], at: [f64; 3]) -> [f64; 3] {
    let own = axes.map(|axis| (0..3).map(|d| axis[d] * at[d]).sum::<f64>());
    let [x, y, z] = own;
    let moved = [eps[0] * x + eps[3] * y, eps[1] * y + eps[4] * z, eps[2] * z + eps[5] * x];
    [0, 1, 2].map(|d| (0..3).map(|i| axes[i][d] * moved[i]).sum())
}

/// A turned element of a turned material has the turned stiffness.
fn rotation(kind: ElementKind, formulation: Formulation, orthotropic: bool) -> Outcome {
    let (sin, cos) = 0.7_f64.sin_cos();
    let about_z = [[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]];
    let about_x = [[1.0, 0.0, 0.0], [0.0, cos, -sin], [0.0, sin, cos]];
    let turn = if kind.dimension() == 2 {
        about_z
    } else {
        [0, 1, 2].map(|i| [0, 1, 2].map(|j| (0..3).map(|k| about_z[i][k] * about_x[k][j]).sum()))
    };
    let apply = |x: [f64; 3]| turn.map(|row: [f64; 3]| (0..3).map(|d| row[d] * x[d]).sum::<f64>());
    let before = if orthotropic { laminate(kind)? } else { aluminium()? };
    let after = match before {
        ElasticMaterial::Orthotropic(OrthotropicMaterial { axes, .. }) => {
            laminate_along(apply(axes[0]), apply(axes[1]))?
        }
        isotropic => isotropic,
    };
    let dimension = kind.dimension();
    let block = DMatrix::from_fn(dimension, dimension, |i, j| turn[i][j]);
    let t = DMatrix::identity(kind.nodes(), kind.nodes()).kronecker(&block);
    for coords in [distorted(kind), curved(kind)] {
        let turned: Vec<_> = coords.iter().copied().map(apply).collect();
        for (p, q) in properties(kind, &before)?.iter().zip(properties(kind, &after)?) {
            let k = stiffness(kind, &coords, p, formulation)?;
            let found = stiffness(kind, &turned, &q, formulation)?;
            let error = (found - &t * &k * t.transpose()).amax() / k.amax();
            assert!(error < 1e-13, "{kind:?}: {error:e}");
        }
    }
    Ok(())
}

/// A uniform stress does the work `sigma : eps` V on its own strain, whatever element holds it.
#[test]
fn strains_of_stresses_have_their_energy() -> Outcome {
    let stress = nalgebra::Matrix3::new(3.0, 1.0, -2.0, 1.0, 5.0, 0.5, -2.0, 0.5, -4.0);
    for kind in [ElementKind::Quad4, ElementKind::Hex8] {
        let in_plane = kind.dimension() == 2;
        let stress = nalgebra::Matrix3::from_fn(|i, j| if in_plane && i.max(j) == 2 { 0.0 } else { stress[(i, j)] });
        for p in all_properties(kind)? {
            let strain = p.strain(&stress).ok_or("a singular elasticity")?;
            for coords in elements(kind) {
                let motion = field(kind, &coords, |x| (strain * nalgebra::Vector3::from(x)).into());
                let energy = motion.dot(&(stiffness(kind, &coords, &p, Formulation::default())? * &motion));
                let exact = stress.dot(&strain) * p.thickness * measure(kind, &coords)?;
                // rounding of an inverse and of the stiffness
                assert!((energy / exact - 1.0).abs() < 1e-11, "{kind:?}: {energy} {exact}");
            }
        }
    }
    Ok(())
}
