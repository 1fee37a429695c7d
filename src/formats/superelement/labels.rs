//! Names of the arrays that say what coordinates are.

/// Arrays of one list of labels.
#[derive(Debug)]
pub(super) struct LabelArrays {
    /// Node and component.
    pub dofs: &'static str,
    /// Bodies of the nodes.
    pub bodies: &'static str,
    /// Positions of the nodes.
    pub positions: &'static str,
    /// Unit vectors.
    pub axes: &'static str,
    /// The matrix whose rows they name.
    pub matrix: &'static str,
    /// What their number should be.
    pub expected: &'static str,
}

/// Of the first coordinates.
pub(super) const INTERFACE: LabelArrays = LabelArrays {
    dofs: "interface_dofs",
    bodies: "interface_bodies",
    positions: "interface_positions",
    axes: "interface_axes",
    matrix: "k",
    expected: "at most as many rows as \"k\"",
};

/// Of the interface that modes stand for.
pub(super) const RECOVERED: LabelArrays = LabelArrays {
    dofs: "recovered_dofs",
    bodies: "recovered_bodies",
    positions: "recovered_positions",
    axes: "recovered_axes",
    matrix: "interface_modes",
    expected: "as many rows as \"interface_modes\"",
};
