//! Elements, materials and fields that the tests share.

use nalgebra::DVector;

use crate::fe::element::ElementError;
use crate::fe::element::continuum::quadrature::{
    conical_pyramid, conical_tetrahedron, conical_triangle, cube, product, square,
};
use crate::fe::element::continuum::{ContinuumProperties, PlaneAssumption, QuadraturePoint};
use crate::fe::material::{ElasticMaterial, Material, MaterialError, OrthotropicMaterial};
use crate::fe::mesh::ElementKind;

/// Kinds of plane elements and solids, in the order of the enum.
pub(super) fn continua() -> impl Iterator<Item = ElementKind> {
    ElementKind::all().filter(|kind| kind.dimension() >= 2)
}

pub(super) const THICKNESS: f64 = 4e-3;
/// A unidirectional carbon laminate.
pub(super) const YOUNG: [f64; 3] = [140e9, 10e9, 9e9];
pub(super) const POISSON: [f64; 3] = [0.3, 0.45, 0.28];
pub(super) const SHEAR: [f64; 3] = [5e9, 3.5e9, 4.5e9];

pub(super) fn aluminium() -> Result<ElasticMaterial, MaterialError> {
    Ok(Material::new(70e9, 0.33, 2700.0)?.into())
}

/// The laminate; turned about z for plane elements, about all axes for solids.
pub(super) fn laminate(kind: ElementKind) -> Result<ElasticMaterial, MaterialError> {
    let (x, y) = match kind.dimension() {
        2 => ([0.8, 0.6, 0.0], [-0.6, 0.8, 0.0]),
        _ => ([0.8, 0.6, 0.3], [-0.2, 0.8, 0.5]),
    };
    laminate_along(x, y)
}

pub(super) fn laminate_along(x: [f64; 3], y: [f64; 3]) -> Result<ElasticMaterial, MaterialError> {
    Ok(OrthotropicMaterial::new(YOUNG, POISSON, SHEAR, 1600.0, x, y)?.into())
}

/// What an element of this kind can be made of: plane stress and plane strain, or solid.
pub(super) fn properties(
    kind: ElementKind,
    material: &ElasticMaterial,
) -> Result<Vec<ContinuumProperties>, ElementError> {
    if kind.dimension() == 3 {
        return Ok(vec![ContinuumProperties::solid(material)]);
    }
    [PlaneAssumption::Stress, PlaneAssumption::Strain]
        .into_iter()
        .map(|assumption| ContinuumProperties::plane(material, assumption, THICKNESS))
        .collect()
}

/// Of both materials.
pub(super) fn all_properties(kind: ElementKind) -> Result<Vec<ContinuumProperties>, Box<dyn std::error::Error>> {
    let mut all = properties(kind, &aluminium()?)?;
    all.extend(properties(kind, &laminate(kind)?)?);
    Ok(all)
}

/// An affine picture of the natural element: a general triangle or tetrahedron, a parallelepiped, a straight
/// prism.
pub(super) fn straight(kind: ElementKind) -> Vec<[f64; 3]> {
    let place = |&[x, y, z]: &[f64; 3]| {
        let plane = [1.1 * x + 0.2 * y + 0.3, 0.9 * y - 0.15 * x - 0.2];
        match kind.dimension() {
            2 => [plane[0], plane[1], 0.0],
            _ => [plane[0] + 0.1 * z, plane[1] + 0.2 * z, 1.2 * z + 0.05 * x - 0.1 * y + 0.4],
        }
    };
    kind.natural_nodes().iter().map(place).collect()
}

/// Corners moved by up to 0.12, middle nodes in the middle of their straight edges, others in the mean of their corners.
pub(super) fn distorted(kind: ElementKind) -> Vec<[f64; 3]> {
    let mut coords = straight(kind);
    for (i, node) in coords[..kind.corners()].iter_mut().enumerate() {
        for (d, value) in node[..kind.dimension()].iter_mut().enumerate() {
            *value += 0.12 * (7.0 * i as f64 + 3.0 * d as f64 + 1.0).sin();
        }
    }
    for (around, i) in kind.beyond_corners().zip(kind.corners()..) {
        coords[i] = mean(around.iter().map(|&corner| coords[corner]));
    }
    coords
}

/// The mean of some points.
pub(super) fn mean(points: impl ExactSizeIterator<Item = [f64; 3]> + Clone) -> [f64; 3] {
    [0, 1, 2].map(|d| points.clone().map(|x| x[d]).sum::<f64>() / points.len() as f64)
}

/// The distorted element with its middle nodes, if there are any, moved by up to 0.04.
pub(super) fn curved(kind: ElementKind) -> Vec<[f64; 3]> {
    let mut coords = distorted(kind);
    for (i, node) in coords.iter_mut().enumerate().skip(kind.corners()) {
        for (d, value) in node[..kind.dimension()].iter_mut().enumerate() {
            *value += 0.04 * (5.0 * i as f64 + 2.0 * d as f64).cos();
        }
    }
    coords
}

/// Three shapes for quadratic kinds, two for linear ones.
pub(super) fn elements(kind: ElementKind) -> Vec<Vec<[f64; 3]>> {
    let mut all = vec![straight(kind), distorted(kind)];
    if !kind.middle_edges().is_empty() {
        all.push(curved(kind));
    }
    all
}

/// A rule far beyond every degree that occurs: 12 points a direction.
pub(super) fn very_fine(kind: ElementKind) -> Vec<QuadraturePoint> {
    match (kind.dimension(), kind.corners()) {
        (2, 3) => conical_triangle(12),
        (2, _) => square(12),
        (_, 4) => conical_tetrahedron(12),
        (_, 5) => conical_pyramid(12, 12),
        (_, 6) => product(&conical_triangle(12), 12, 2),
        _ => cube(12),
    }
}

/// A displacement field at the nodes.
pub(super) fn field(kind: ElementKind, coords: &[[f64; 3]], u: impl Fn([f64; 3]) -> [f64; 3]) -> DVector<f64> {
    let values: Vec<f64> = coords.iter().flat_map(|&x| u(x).into_iter().take(kind.dimension())).collect();
    DVector::from_vec(values)
}

/// Three rigid motions of the plane or six of space.
pub(super) fn rigid_motions(kind: ElementKind, coords: &[[f64; 3]]) -> Vec<DVector<f64>> {
    let motion = |which: usize| {
        field(kind, coords, move |[x, y, z]| match which {
            0 => [1.0, 0.0, 0.0],
            1 => [0.0, 1.0, 0.0],
            2 => [-y, x, 0.0],
            3 => [0.0, 0.0, 1.0],
            4 => [0.0, -z, y],
            _ => [z, 0.0, -x],
        })
    };
    let count = if kind.dimension() == 2 { 3 } else { 6 };
    (0..count).map(motion).collect()
}

pub(super) fn message<T: std::fmt::Debug>(result: Result<T, ElementError>) -> String {
    match result {
        Ok(value) => format!("accepted: {value:?}"),
        Err(error) => error.to_string(),
    }
}
