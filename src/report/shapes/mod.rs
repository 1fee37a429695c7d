//! A meshed structure in space and its mode shapes: a view to turn and animate in the browser, and pictures of the same
//! for print.
//!
//! The data go one way: [`ModeShapeView`] is checked, brought down to the points that its surface uses, thinned where
//! the page would grow too large, packed for the script, and drawn as SVG without hidden surfaces.

mod camera;
mod pack;
mod picture;
#[cfg(test)]
#[path = "samples_tests.rs"]
pub(crate) mod samples;
mod stills;
mod surface;
mod view;

pub use camera::UpAxis;
pub(super) use pack::{Packed, compressed, pack};
pub(super) use stills::{bar as colour_bar, mesh_picture, stills};
pub(super) use surface::Surface;
pub(super) use view::legend;
pub use view::{ModeShapeView, ShapeFigures, ShapeGroup, ShapeLine, ShapeMode, ShapeTriangle};
