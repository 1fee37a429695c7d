//! Supports and point masses of a housing, as they are asked for.

/// What a support does to the nodes of its group.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Constraint {
    /// Displacement components (x, y) that are held at zero.
    Fixed([bool; 2]),
    /// Springs to the ground in x and in y, N/m.
    Spring([f64; 2]),
    /// Springs to the ground along the radius from the ring's centre, N/m.
    Radial(f64),
}

/// Whether each node gets the stiffness, or the group shares it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SupportShare {
    /// Each node carries the given stiffness: depends on the mesh.
    PerNode,
    /// The group carries it, spread by length (curves) or equally (points).
    PerGroup,
}

/// A support of a named group.
#[derive(Debug, Clone, PartialEq)]
pub struct HousingSupport {
    /// The group.
    pub group: String,
    /// What it does.
    pub constraint: Constraint,
    /// How a stiffness is meant; without meaning for `Fixed`.
    pub share: SupportShare,
}

/// A mass spread over a named group.
#[derive(Debug, Clone, PartialEq)]
pub struct PointMass {
    /// The group.
    pub group: String,
    /// Its mass, kg, > 0.
    pub mass: f64,
}
