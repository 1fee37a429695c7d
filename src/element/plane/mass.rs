//! Consistent mass matrices.

use nalgebra::DMatrix;

use super::jacobian::{check, determinant_at};
use super::stiffness::check_shape;
use super::{PlaneKind, PlaneProperties, shape_values};
use crate::element::ElementError;

/// Consistent mass `M = rho t int N^T N dA`, kg, into `out` (dof x dof; whatever it held is replaced).
///
/// `N` (2 x dof) interpolates the displacement; integrated by [`PlaneKind::mass_rule`], exactly for any
/// geometry. `coords`: one (x, y) a node in gmsh's order, m. The mass met by a translation is
/// `rho t A`, and with `M` frequencies converge from above. Source: Bathe, equation 4.20.
///
/// # Errors
/// [`ElementError`] for a wrong number of coordinates or buffer shape, or an element that is inverted,
/// degenerate or folded.
pub fn mass_into(
    kind: PlaneKind,
    coords: &[[f64; 2]],
    properties: &PlaneProperties,
    out: &mut DMatrix<f64>,
) -> Result<(), ElementError> {
    check_shape(kind, out)?;
    let rule = kind.mass_rule();
    check(kind, coords, rule)?;
    let surface_density = properties.material.density * properties.thickness;
    let nodes = kind.nodes();
    out.fill(0.0);
    for point in rule.points() {
        let determinant = determinant_at(kind, coords, point.natural);
        let weight = surface_density * point.weight * determinant;
        let values = shape_values(kind, point.natural);
        let values = &values[..nodes];
        for (b, right) in values.iter().enumerate() {
            for (a, left) in values[..=b].iter().enumerate() {
                let entry = weight * left * right;
                out[(2 * a, 2 * b)] += entry;
                out[(2 * a + 1, 2 * b + 1)] += entry;
            }
        }
    }
    out.fill_lower_triangle_with_upper_triangle();
    Ok(())
}

/// [`mass_into`] a new matrix.
///
/// # Errors
/// As [`mass_into`].
pub fn mass(
    kind: PlaneKind,
    coords: &[[f64; 2]],
    properties: &PlaneProperties,
) -> Result<DMatrix<f64>, ElementError> {
    let mut out = DMatrix::zeros(kind.dof(), kind.dof());
    mass_into(kind, coords, properties, &mut out)?;
    Ok(out)
}
