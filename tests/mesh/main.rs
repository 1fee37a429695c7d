//! Meshes from gmsh's files: what the reader takes, what it refuses, and in which words.

mod damaged;
mod import;
mod solids;
