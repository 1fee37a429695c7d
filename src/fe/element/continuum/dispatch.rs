//! From a kind to the code made for its numbers of nodes and directions.

/// `function::<N, D>(...)` for the N nodes and D displacements a node of a kind: loops of known length, which
/// the compiler unrolls and vectorises.
macro_rules! for_kind {
    ($kind:expr, $function:ident($($argument:expr),* $(,)?)) => {{
        use $crate::fe::element::continuum::ContinuumKind as Kind;
        match $kind {
            Kind::Tri3 => $function::<3, 2>($($argument),*),
            Kind::Tri6 => $function::<6, 2>($($argument),*),
            Kind::Quad4 => $function::<4, 2>($($argument),*),
            Kind::Quad8 => $function::<8, 2>($($argument),*),
            Kind::Tet4 => $function::<4, 3>($($argument),*),
            Kind::Tet10 => $function::<10, 3>($($argument),*),
            Kind::Hex8 => $function::<8, 3>($($argument),*),
            Kind::Hex20 => $function::<20, 3>($($argument),*),
            Kind::Wedge6 => $function::<6, 3>($($argument),*),
            Kind::Wedge15 => $function::<15, 3>($($argument),*),
        }
    }};
}

pub(super) use for_kind;
