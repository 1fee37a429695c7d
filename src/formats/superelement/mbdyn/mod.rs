//! A superelement as the data of MBDyn's modal element (`.fem`).
//!
//! MBDyn carries the large rigid motion of a modal element by a node of its own and adds the element's shapes to it, so
//! that a free body's shapes must not have rigid motions in them; of a body that is clamped to the ground there are none.
//! What is written are therefore eigenvectors of the condensed housing, `k v = lambda m v`, either with one interface node
//! held, as the manual recommends, or without the rigid ones ([`MbdynReference`]). Together with the rigid motion they are
//! the same space as the interface displacements and fixed-interface modes; mass (1) and stiffness (lambda) are diagonal.
//! All count as normal modes, as the manual advises; which of them are used is chosen in MBDyn's input.
//!
//! Source: MBDyn Input File Format, appendix "Modal Element Data", section "FEM File Format" (records 1 to 13) and its
//! subsection "Usage"; section "Modal" of the joint elements for the node that is held, `origin node` and `clamped`.

mod modal;
mod nodes;
#[cfg(test)]
mod tests;
mod write;

pub use modal::{MbdynReference, MbdynSummary, write_mbdyn_fem};
