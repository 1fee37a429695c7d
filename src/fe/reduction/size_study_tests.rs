use super::*;
use crate::fe::reduction::parts::dense;
use crate::fe::reduction::samples::{every_third, rod, train};
use crate::fe::reduction::{
    Attached, BasisChoice, BasisSize, CraigBampton, InterfaceReduction, InterfaceSize, choose_basis,
};
use crate::numerics::Unwatched;
use crate::numerics::linalg::symmetric_generalised_eigen;
use std::f64::consts::TAU;

const NODES: usize = 150;

/// Interior vectors are few of a rod that is held by every third node, so that every curve has something to gain.
#[test]
fn errors_are_those_of_the_reductions_themselves() {
    let matrices = rod(NODES);
    let partition = every_third(NODES);
    let substructure = Substructure::new(&matrices, &partition).expect("connected");
    let [stiffness, mass] = &train(50, 5.0, 0.3, 0.0);
    let attached = Some(Attached { stiffness, mass });
    let one = DenseMatrix::from_fn(50, 1, |_, _| 1.0);
    let interface = CharacteristicModes::of(&substructure, attached, &one).expect("finite");
    let (mut k, mut m) = (dense(&matrices.stiffness), dense(&matrices.mass));
    for (row, &dof) in partition.driven.iter().enumerate() {
        for (column, &other) in partition.driven.iter().enumerate() {
            k[(dof, other)] += stiffness[(row, column)];
            m[(dof, other)] += mass[(row, column)];
        }
    }
    let full = symmetric_generalised_eigen(&k, &m).expect("definite").values;
    let full: Vec<f64> = full[..10].iter().map(|v| v.max(0.0).sqrt() / TAU).collect();
    let rows = size_study(&substructure, &interface, &full, 1, &Unwatched).expect("definite");
    assert_eq!(rows.iter().map(|row| row.size).collect::<Vec<_>>(), SIZES);
    // ten frequencies need ten coordinates, of which the interface has enough
    assert!(rows[0].reduced.is_none() && rows[0].plain.is_some());
    for row in &rows {
        let basis = |count: usize, enhanced: bool| {
            let choice = BasisChoice { size: BasisSize::Count(count), enhanced, band_hz: 0.1 };
            choose_basis(&substructure, choice, attached, &Unwatched).expect("definite")
        };
        let error = |values: Vec<f64>| largest_error(&values, &full, 1).expect("enough");
        let condensed = |basis| CraigBampton::new(substructure.clone(), basis, &matrices.weight);
        let whole = |basis: InteriorBasis| {
            let all = super::super::interior_basis::coupled_modes(&substructure, &basis, attached);
            error(all.expect("definite").values)
        };
        // frequencies to 1e-11, see the test of the lowest modes
        let near = |found: f64, expected: f64| (found - expected).abs() < 1e-10;
        let plain = whole(basis(row.size, false));
        assert!(near(row.plain.expect("enough"), plain), "{row:?} {plain:e}");
        let enhanced = whole(basis(row.size, true));
        // the same vectors from modes of two solvers, each to 1e-6
        let found = row.enhanced.expect("enough");
        assert!((found - enhanced).abs() < 1e-5 * enhanced + 1e-10, "{row:?} {enhanced:e}");
        let Some(split) = row.reduced else { continue };
        let vectors = split.fixed_interface_modes + split.residual_vectors;
        assert_eq!(split.interface_modes + vectors, row.size);
        let reduction = InterfaceReduction::new(
            &condensed(basis(vectors, split.residual_vectors > 0)),
            &interface,
            InterfaceSize::Count(split.interface_modes),
        );
        let values = reduction.expect("enough").coupled_values(attached);
        let direct = error(values.expect("definite"));
        assert!((split.error - direct).abs() < 1e-5 * direct + 1e-10, "{row:?} {direct:e}");
    }
    // more coordinates are never worse by plain modes, nor by the best of more splits
    let fell = |errors: Vec<f64>| errors.windows(2).all(|two| two[1] < two[0] + 1e-10);
    assert!(fell(rows.iter().filter_map(|row| row.plain).collect()));
    assert!(rows.iter().all(|row| row.plain.expect("enough") > -1e-10));
}

#[test]
fn too_few_coordinates_have_no_error() {
    let two_thousandths = (TAU * 2e-3_f64).powi(2);
    assert_eq!(largest_error(&[0.0], &[0.0, 1.0], 1), None);
    let found = largest_error(&[0.0, two_thousandths], &[0.0, 1e-3], 1).expect("enough");
    assert!((found - 1.0).abs() < 1e-12);
}
