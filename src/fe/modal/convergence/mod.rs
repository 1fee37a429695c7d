//! How far frequencies of a mesh are from those of an infinitely fine one, from two meshes or more.

mod richardson;

pub use richardson::{Behaviour, Convergence, MeshLevels, richardson};

#[cfg(test)]
mod tests;
