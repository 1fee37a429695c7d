//! One harness for every continuum element and formulation: a line each, all checks the same.

mod beam;
mod errors;
mod fixtures;
mod matrices;
mod patch;
mod properties;
mod quality;
mod rules;
mod shapes;
mod surface;
mod wave;

use super::{Formulation, Integration, LinearFormulation};
use crate::fe::mesh::ElementKind;

type Outcome = Result<(), Box<dyn std::error::Error>>;

const FOUR_POINT: Formulation =
    Formulation { integration: Integration::FourPoint, linear: LinearFormulation::Incompatible };
const PLAIN: Formulation = Formulation { integration: Integration::Full, linear: LinearFormulation::Plain };

/// A test an element and formulation.
macro_rules! harness {
    ($($name:ident: $kind:ident, $formulation:expr;)*) => {$(
        #[test]
        fn $name() -> Outcome {
            let (kind, formulation) = (ElementKind::$kind, $formulation);
            shapes::check(kind);
            matrices::check(kind, formulation)?;
            patch::check(kind, formulation)?;
            errors::check(kind, formulation)
        }
    )*};
}

harness! {
    tri3: Tri3, Formulation::default();
    tri6: Tri6, Formulation::default();
    quad4: Quad4, Formulation::default();
    quad4_plain: Quad4, PLAIN;
    quad8: Quad8, Formulation::default();
    quad9: Quad9, Formulation::default();
    tet4: Tet4, Formulation::default();
    tet10: Tet10, Formulation::default();
    tet10_four_point: Tet10, FOUR_POINT;
    hex8: Hex8, Formulation::default();
    hex8_plain: Hex8, PLAIN;
    hex20: Hex20, Formulation::default();
    hex27: Hex27, Formulation::default();
    wedge6: Wedge6, Formulation::default();
    wedge15: Wedge15, Formulation::default();
    wedge18: Wedge18, Formulation::default();
    pyramid5: Pyramid5, Formulation::default();
    pyramid13: Pyramid13, Formulation::default();
    pyramid14: Pyramid14, Formulation::default();
}
