//! Stiffness matrices.

use nalgebra::DMatrix;

use super::jacobian::{check, map};
use super::properties::Elasticity;
use super::{PlaneKind, PlaneProperties, QuadratureRule};
use crate::element::ElementError;

/// Stiffness `K = t int B^T D B dA`, N/m, into `out` (dof x dof; whatever it held is replaced).
///
/// `B` (3 x dof) gives (eps_x, eps_y, gamma_xy), `D` (3 x 3) the plane elasticity, t the thickness;
/// integrated by [`PlaneKind::stiffness_rule`]. `coords`: one (x, y) a node in gmsh's order, m. Force
/// components that hold the element in a given displacement are `K u`; a rigid motion needs none.
/// Source: Bathe, equation 4.19.
///
/// # Errors
/// [`ElementError`] for a wrong number of coordinates or buffer shape, or an element that is inverted,
/// degenerate or folded.
pub fn stiffness_into(
    kind: PlaneKind,
    coords: &[[f64; 2]],
    properties: &PlaneProperties,
    out: &mut DMatrix<f64>,
) -> Result<(), ElementError> {
    check_shape(kind, out)?;
    let rule = kind.stiffness_rule();
    check(kind, coords, rule)?;
    integrate(kind, coords, properties, rule, out);
    Ok(())
}

/// The integral over an element and a buffer that have been checked.
pub(super) fn integrate(
    kind: PlaneKind,
    coords: &[[f64; 2]],
    properties: &PlaneProperties,
    rule: QuadratureRule,
    out: &mut DMatrix<f64>,
) {
    let elasticity = properties.elasticity();
    let nodes = kind.nodes();
    out.fill(0.0);
    for point in rule.points() {
        let mapped = map(kind, coords, point.natural);
        let volume = point.weight * mapped.determinant * properties.thickness;
        let gradients = &mapped.gradients[..nodes];
        for (b, &right) in gradients.iter().enumerate() {
            for (a, &left) in gradients[..=b].iter().enumerate() {
                let block = coupling(&elasticity, left, right);
                for i in 0..2 {
                    for j in 0..2 {
                        out[(2 * a + i, 2 * b + j)] += volume * block[i][j];
                    }
                }
            }
        }
    }
    out.fill_lower_triangle_with_upper_triangle();
}

/// [`stiffness_into`] a new matrix.
///
/// # Errors
/// As [`stiffness_into`].
pub fn stiffness(
    kind: PlaneKind,
    coords: &[[f64; 2]],
    properties: &PlaneProperties,
) -> Result<DMatrix<f64>, ElementError> {
    let mut out = DMatrix::zeros(kind.dof(), kind.dof());
    stiffness_into(kind, coords, properties, &mut out)?;
    Ok(out)
}

/// `B_a^T D B_b` (2 x 2) from the gradients of two shape functions.
fn coupling(d: &Elasticity, a: [f64; 2], b: [f64; 2]) -> [[f64; 2]; 2] {
    [
        [
            d.direct * a[0] * b[0] + d.shear * a[1] * b[1],
            d.cross * a[0] * b[1] + d.shear * a[1] * b[0],
        ],
        [
            d.cross * a[1] * b[0] + d.shear * a[0] * b[1],
            d.direct * a[1] * b[1] + d.shear * a[0] * b[0],
        ],
    ]
}

/// The buffer is dof x dof.
pub(super) fn check_shape(kind: PlaneKind, out: &DMatrix<f64>) -> Result<(), ElementError> {
    if out.shape() == (kind.dof(), kind.dof()) {
        Ok(())
    } else {
        Err(ElementError::BufferShape {
            kind: kind.name(),
            expected: kind.dof(),
            rows: out.nrows(),
            columns: out.ncols(),
        })
    }
}
