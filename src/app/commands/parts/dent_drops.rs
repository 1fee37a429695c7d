//! How far a ball sinks into a defect, by the profile that is in use and by the other.

use crate::bearing::defect::{Dent, DentShape, RaceDefect, RaceProfile, SurfaceDent};
use crate::bearing::{BearingGeometry, ContactStiffness};

/// Name of the drop and its value (m). A dent with a width has two, in the plane and in its surface, as far as its
/// shape allows both.
pub(crate) fn drops(
    geometry: &BearingGeometry,
    stiffness: ContactStiffness,
    defect: &RaceDefect,
) -> Vec<(&'static str, f64)> {
    let race = defect.race();
    let in_plane = |shape: &DentShape| {
        let dent = Dent::new(geometry, race, *shape, stiffness).ok()?;
        Some(("Drop of a ball in the dent, in the plane", dent.ball_drop()))
    };
    let surface = |shape: &DentShape| {
        let dent = SurfaceDent::new(geometry, race, *shape, stiffness).ok()?;
        let name = "Drop of a ball in the dent, in its surface";
        Some((name, dent.ball_drop()))
    };
    let used = |name| Some((name, defect.ball_drop()));
    let both = match defect {
        RaceDefect::Dent(dent) if dent.shape().width.is_some() => {
            [used("Drop of a ball in the dent, in the plane (in use)"), surface(dent.shape())]
        }
        RaceDefect::Dent(_) => [used("Drop of a ball in the dent"), None],
        RaceDefect::SurfaceDent(dent) => {
            [in_plane(dent.shape()), used("Drop of a ball in the dent, in its surface (in use)")]
        }
        RaceDefect::Measured(_) => [used("Drop of a ball in the measured profile"), None],
    };
    both.into_iter().flatten().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bearing::Race;
    use crate::bearing::defect::CurvatureReading;
    use crate::bearing::samples::source_bearing;

    fn shape(width: Option<f64>) -> DentShape {
        DentShape {
            angle: 0.0,
            length: 0.75e-3,
            width,
            depth: 15e-6,
            rim_radius: 0.05e-3,
            curvature: CurvatureReading::Total,
        }
    }

    #[test]
    fn a_dent_with_a_width_has_both_drops() {
        let geometry = source_bearing();
        let stiffness = ContactStiffness::given(1e10, 1e10).unwrap();
        let of = |defect: &RaceDefect| {
            let drops = drops(&geometry, stiffness, defect).into_iter();
            drops.map(|(name, drop)| format!("{name}: {:.2}", 1e6 * drop)).collect::<Vec<_>>()
        };
        let in_plane = |width| {
            let dent = Dent::new(&geometry, Race::Outer, shape(width), stiffness);
            RaceDefect::Dent(dent.unwrap())
        };
        let surface = SurfaceDent::new(&geometry, Race::Outer, shape(Some(0.41e-3)), stiffness);
        assert_eq!(
            of(&in_plane(Some(0.41e-3))),
            [
                "Drop of a ball in the dent, in the plane (in use): 15.00",
                "Drop of a ball in the dent, in its surface: 1.41"
            ]
        );
        assert_eq!(
            of(&RaceDefect::SurfaceDent(surface.unwrap())),
            [
                "Drop of a ball in the dent, in the plane: 15.00",
                "Drop of a ball in the dent, in its surface (in use): 1.41"
            ]
        );
        assert_eq!(of(&in_plane(None)), ["Drop of a ball in the dent: 15.00"]);
        // no surface dent is as wide as the ball
        assert_eq!(of(&in_plane(Some(3e-3))), ["Drop of a ball in the dent, in the plane (in use): 15.00"]);
    }
}
