//! Rigid motions of a set of nodes, and modes over all degrees of freedom.

use super::error::{ModalError, check_count};
use crate::fe::model::{HousingModel, RingSeat, Rings};
use crate::numerics::linalg::{DenseMatrix, scattered_rows, sparse_times_dense};

/// Unit rigid motions R of some nodes [d nodes x 3 or 6]: translations along x, y (and z), m, then rotations about
/// axes through `about` (m), rad: about z in the plane, about x, y and z in space.
///
/// `u = t + omega x (x - about)`, a column for each component of t and of omega. `dimension` is 2 for a plane
/// model, otherwise 3. Source: Craig and Kurdila, Fundamentals of
/// Structural Dynamics (2006).
pub(crate) fn rigid_motions(coordinates: &[[f64; 3]], dimension: usize, about: [f64; 3]) -> DenseMatrix {
    let d = if dimension == 2 { 2 } else { 3 };
    DenseMatrix::from_fn(d * coordinates.len(), rigid_count(d), |row, motion| {
        let (node, component) = (row / d, row % d);
        let arm = [0, 1, 2].map(|axis| coordinates[node][axis] - about[axis]);
        rigid_component(d, arm, component, motion)
    })
}

/// A component of the displacement at `arm` from the axes in a unit rigid motion: a translation, or `e_axis x arm`.
pub(super) fn rigid_component(d: usize, arm: [f64; 3], component: usize, motion: usize) -> f64 {
    if motion < d {
        return f64::from(u8::from(motion == component));
    }
    let axis = if d == 2 { 2 } else { motion - 3 };
    if component == (axis + 1) % 3 {
        -arm[(axis + 2) % 3]
    } else if component == (axis + 2) % 3 {
        arm[(axis + 1) % 3]
    } else {
        0.0
    }
}

/// Number of rigid motions of one body: 3 in the plane, 6 in space.
pub(super) fn rigid_count(dimension: usize) -> usize {
    if dimension == 2 { 3 } else { 6 }
}

/// Modes over all degrees of freedom [dof x count] from those over `free_dofs` [free x count]: zero where the
/// housing is fixed, at tied nodes what they follow.
///
/// # Errors
/// [`ModalError::Shape`] for another number of rows, or degrees of freedom that the housing has not.
pub fn over_all_dofs(
    model: &HousingModel,
    free_dofs: &[usize],
    shapes: &DenseMatrix,
) -> Result<DenseMatrix, ModalError> {
    check_count("rows of the modes", free_dofs.len(), shapes.nrows())?;
    if let Some(&outside) = free_dofs.iter().find(|&&dof| dof >= model.dof()) {
        return Err(ModalError::Shape {
            what: "degrees of freedom of the housing",
            expected: model.dof(),
            found: outside + 1,
        });
    }
    let all = scattered_rows(shapes, free_dofs, model.dof());
    Ok(match model.tie_matrix() {
        Some(tie) => sparse_times_dense(&tie, &all),
        None => all,
    })
}

/// Unit rigid motions of all rings' nodes [ring dof x 3 or 6] in the order of [`rigid_motions`]: along the mesh's axes and
/// about axes along them through `about` (m).
pub(crate) fn ring_motions(rings: &Rings, about: [f64; 3]) -> DenseMatrix {
    let mut all = DenseMatrix::zeros(rings.dof(), if rings.are_in_space() { 6 } else { 3 });
    for seat in rings.seats() {
        let own = seat_motions(seat, about);
        all.subrows_mut(seat.first, own.nrows()).copy_from(own);
    }
    all
}

/// The same of one ring.
pub(super) fn seat_motions(RingSeat { ring, frame, .. }: &RingSeat, about: [f64; 3]) -> DenseMatrix {
    let centre = frame.centre();
    let arm = [0, 1, 2].map(|axis| centre[axis] - about[axis]);
    let motion = |axis: usize, turns: bool| {
        let mut unit = [0.0; 3];
        unit[axis] = 1.0;
        let (translation, rotation) = if turns { ([0.0; 3], unit) } else { (unit, [0.0; 3]) };
        let [x, y, z] = rotation;
        let carried = [y * arm[2] - z * arm[1], z * arm[0] - x * arm[2], x * arm[1] - y * arm[0]];
        let of_centre = [0, 1, 2].map(|axis| translation[axis] + carried[axis]);
        ring.rigid_motion_in_space(frame.vector(of_centre), frame.vector(rotation))
    };
    let motions: Vec<Vec<f64>> = match ring.is_in_space() {
        true => (0..6).map(|place| motion(place % 3, place >= 3)).collect(),
        false => vec![motion(0, false), motion(1, false), motion(2, true)],
    };
    DenseMatrix::from_fn(ring.dof(), motions.len(), |row, column| motions[column][row])
}

#[cfg(test)]
mod tests {
    use super::super::ModalError;
    use super::super::samples::{Cells, description};
    use super::{over_all_dofs, rigid_motions};
    use crate::fe::model::HousingModel;
    use crate::numerics::linalg::DenseMatrix;

    #[test]
    fn modes_over_other_degrees_of_freedom_are_refused() {
        let cells = Cells::new(2, [0.1; 3]).block("b", 0, [0; 3], [1, 1, 1]);
        let model = HousingModel::new(&cells.mesh, description(&cells, &["b"], 1.0));
        let model = model.expect("a model");
        let shapes = DenseMatrix::identity(2, 1);
        let all = over_all_dofs(&model, &[5, 0], &shapes).expect("two of eight");
        let expected = |dof: usize| f64::from(u8::from(dof == 5));
        assert!((0..8).all(|dof| (all[(dof, 0)] - expected(dof)).abs() < 1e-15));
        for free in [&[5, 0, 1][..], &[5, 8]] {
            let found = over_all_dofs(&model, free, &shapes);
            assert!(matches!(found, Err(ModalError::Shape { .. })), "{free:?}");
        }
    }

    #[test]
    fn rotations_turn_by_the_right_hand_rule() {
        let nodes = [[1.0, 2.0, 3.0], [0.0, 0.0, 0.0]];
        let about = [0.5, 0.5, 0.5];
        let r = rigid_motions(&nodes, 3, about);
        assert_eq!((r.nrows(), r.ncols()), (6, 6));
        // omega x (0.5, 1.5, 2.5), exact in binary
        let expected = [[0.0, -2.5, 1.5], [2.5, 0.0, -0.5], [-1.5, 0.5, 0.0]];
        for axis in 0..3 {
            for i in 0..3 {
                assert!((r[(i, 3 + axis)] - expected[axis][i]).abs() < 1e-15);
                assert!((r[(3 + i, axis)] - f64::from(u8::from(i == axis))).abs() < 1e-15);
            }
        }
        let plane = rigid_motions(&nodes, 2, about);
        assert_eq!((plane.nrows(), plane.ncols()), (4, 3));
        assert!((plane[(0, 2)] + 1.5).abs() < 1e-15 && (plane[(1, 2)] - 0.5).abs() < 1e-15);
    }
}
