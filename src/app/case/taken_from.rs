//! What a named bearing is taken from, in words, and which of its numbers no maker says.

use super::Bearing;
use super::named_bearing::{GIVEN, lengths};
use crate::bearing::catalogue::{CatalogueBearing, UsualNumbers};
use crate::report::quantity;

impl Bearing {
    /// What a named bearing is taken from, and which of its numbers no maker says of it; `None` without a name.
    pub(crate) fn taken_from(&self) -> Option<String> {
        let bearing = CatalogueBearing::named(self.name.as_ref()?)?;
        let play = UsualNumbers::of(bearing).play;
        let same = |a: f64, b: f64| a.to_bits() == b.to_bits();
        let catalogue = lengths(bearing, self.ball_radius);
        let own = [self.inner_race_radius, self.outer_race_radius, self.inner_groove_radius, self.outer_groove_radius];
        let differ = [self.balls != bearing.balls as usize, !same(self.ball_radius, 0.5 * bearing.ball_diameter)];
        let differ =
            differ.into_iter().chain(own.into_iter().zip(&catalogue[1..]).map(|(own, usual)| !same(own, *usual)));
        let differ: Vec<bool> = differ.collect();
        let given: Vec<&str> =
            GIVEN.into_iter().zip(&differ).filter(|(_, differs)| **differs).map(|(key, _)| key).collect();
        let mut guessed = Vec::new();
        if !bearing.pitch_published && differ[2..4].contains(&false) {
            guessed.push(
                "the races lie about the mean of bore and outer diameter, for no pitch diameter is published"
                    .to_owned(),
            );
        }
        if differ[4..].contains(&false) {
            guessed.push(
                "groove radii of 0.52 (inner) and 0.53 (outer) of the ball's diameter are usual ones, no maker's"
                    .to_owned(),
            );
        }
        if self.radial_play.is_some_and(|own| same(own, play)) {
            guessed.push(format!(
                "a radial play of {} is half the middle of the clearance of group N: tight fits and a warm inner ring take part of it away",
                quantity(play, "m")
            ));
        }
        if let Some(parts) = CatalogueBearing::left_out(self.name.as_ref()?) {
            guessed.push(format!("nothing is taken from {parts} beside its number"));
        }
        let beside = match given.as_slice() {
            [] => String::new(),
            given => format!(", but for {} of the case", given.join(", ")),
        };
        let guessed = match guessed.as_slice() {
            [] => String::new(),
            guessed => format!("; {}; give your own in [bearing]", guessed.join("; ")),
        };
        Some(format!(
            "bearing {}: balls and diameters are those of {}{beside}{guessed}",
            bearing.name,
            bearing.source.citation()
        ))
    }
}
