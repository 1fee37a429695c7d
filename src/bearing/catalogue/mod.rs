//! Common deep groove ball bearings with their inner dimensions, each number with its source.
//!
//! Number and size of the balls are the maker's own choice, which the standard of outer dimensions (ISO 15) leaves open: of the
//! bearings that both makers below publish, 6004 and 6208 differ (8 balls of 6.35 mm and 9 of 12.70 mm at Timken, against 9 of
//! 6.350 mm and 9 of 11.906 mm at GMN). Orders of a bearing at hand are best taken from its own maker.
//!
//! **Limitations**: no raceway radii and no groove radii: makers do not publish them. They follow from ball and pitch diameter, a
//! [clearance](normal_clearance) and [typical grooves](GROOVES).

mod table;

pub use table::{CatalogueBearing, GROOVES, OuterRingSection, Source, UsualNumbers, normal_clearance};

#[cfg(test)]
mod tests;
