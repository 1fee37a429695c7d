//! Supports, point masses and links of a housing, as they are asked for.

/// What a support does to the nodes of its group.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Constraint {
    /// Displacement components (x, y, z) of the mesh's axes that are held at zero.
    Fixed([bool; 3]),
    /// Springs to the ground.
    Spring(SpringStiffness),
}

/// Stiffness of a spring.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SpringStiffness {
    /// Along the mesh's axes x, y, z, N/m.
    Global([f64; 3]),
    /// Along the radius from the bearing's axis, N/m.
    Radial(f64),
}

/// Whether each node gets the stiffness, or the group shares it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SupportShare {
    /// Each node carries the given stiffness: depends on the mesh.
    PerNode,
    /// The group carries it, spread by volume, area or length, equally over points.
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

/// A connection between two groups of a housing. Nodes of one are connected to the nearest points of the other, so
/// the meshes need not match.
#[derive(Debug, Clone, PartialEq)]
pub struct Link {
    /// Springs connect the nodes of the first to points of the second.
    pub between: [String; 2],
    /// How.
    pub connection: Connection,
}

/// How two groups are connected.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Connection {
    /// By springs.
    Spring(SpringStiffness, SupportShare),
    /// Two surfaces move as one: the nodes of the finer follow the coarser.
    Tie,
}
