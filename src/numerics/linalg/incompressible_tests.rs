//! Factors in single precision of nearly incompressible material: used where they serve, refused where they do not.

use super::super::Plan;
use super::super::{DenseMatrix, Ordering, Pattern, SparseMatrix};
use super::*;
use crate::fe::assembly::SystemMatrices;
use crate::fe::material::Material;
use crate::fe::mesh::Mesh;
use crate::fe::model::{Constraint, HousingDescription, HousingModel, HousingPart, HousingSupport, SupportShare};
use crate::numerics::units::LengthUnit;
use std::path::Path;

/// Stiffness and mass of a pillow block of rubber of ten-noded tetrahedra on fixed feet.
fn block(poisson: f64) -> (SparseMatrix, SparseMatrix, Vec<usize>) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/pedestal_10k.msh");
    let mesh = Mesh::read_gmsh(&path, LengthUnit::Metre).expect("a mesh");
    let rubber = Material::new(1e7, poisson, 1100.0).expect("rubber");
    let description = HousingDescription {
        parts: vec![HousingPart { group: "housing".to_owned(), material: rubber.into() }],
        supports: vec![HousingSupport {
            group: "feet".to_owned(),
            constraint: Constraint::Fixed([true; 3]),
            share: SupportShare::PerNode,
        }],
        ..HousingDescription::default()
    };
    let model = HousingModel::new(&mesh, description).expect("a model");
    let matrices = SystemMatrices::assemble(&model).expect("matrices");
    (matrices.stiffness, matrices.mass, model.free_dofs())
}

#[test]
fn single_precision_is_left_when_it_does_not_serve() {
    let is_single = |factor: &Factor| matches!(factor.numbers, Numbers::Single(_));
    for (poisson, single) in [
        (0.3, Some(true)),
        (0.49, Some(true)),
        // close to the limit, and on one or the other side of it by the order of the unknowns: found 0.08 and more than 0.1
        (0.4999, None),
        (0.499_999, Some(false)),
        (0.499_999_99, Some(false)),
    ] {
        let (k, m, free) = block(poisson);
        let ordering = Ordering::of_part(Pattern::of(&k), &free).expect("an order");
        let stiffness = SymmetricMatrix::permuted(&k, &ordering);
        let mass = SymmetricMatrix::permuted(&m, &ordering);
        let symbolic = Arc::new(Plan::of(&stiffness).expect("analysed"));
        let factorise = |a: &SymmetricMatrix, kind: Kind| {
            NumericFactor::new(symbolic.own(), a, kind, Vec::new())
                .and_then(|numbers| Factor::measured(&symbolic, a, Numbers::Single(numbers)).judged())
                .or_else(|_| Factor::double(&symbolic, a, kind))
                .expect("in one precision or the other")
        };
        let forced = factorise(&stiffness, Kind::Definite);
        println!("nu = {poisson}: single {}, contraction {:.1e}", is_single(&forced), forced.contraction);
        if let Some(single) = single {
            assert_eq!(is_single(&forced), single, "{poisson}");
        }
        assert!(forced.contraction <= LARGEST_CONTRACTION);
        // refined, whichever it is: a system is solved to what double precision gives
        let x = pseudo_random(free.len(), 2, 3);
        let b = stiffness.times(x.as_ref());
        let mut y = DenseMatrix::zeros(free.len(), 2);
        for _ in 0..12 {
            let mut step = &b - stiffness.times(y.as_ref());
            forced.solve(step.as_mut());
            y += step;
        }
        let error = (&y - &x).norm_max();
        println!("  error {error:.1e}");
        assert!(error < 1e-4, "{poisson}: {error:e}");
        // the count at a shift is that of double precision
        let shifted = stiffness.shifted(1e7, &mass);
        let double = Factor::double(&symbolic, &shifted, Kind::Indefinite).expect("regular");
        let forced = factorise(&shifted, Kind::Indefinite);
        println!(
            "  {} below the shift, single {}, contraction {:.1e}",
            forced.negative(),
            is_single(&forced),
            forced.contraction
        );
        assert_eq!(forced.negative(), double.negative(), "{poisson}");
        assert!(double.negative() > 0);
    }
}
