//! Contact queries of the hot loop on floor and rims: no allocation, no elliptic integral, no error.

use super::contacts::{DefectContact, DefectContacts, Feature, within};
use super::curve::Vector;
use super::depression::Depression;
use super::rim::RimContact;

impl Depression {
    /// All contacts of a roller whose centre is `distance` (m) from the carrier's, and which would touch the
    /// undamaged carrier at `offset` (rad, within ±π) from the middle; in order of angle, gaps included.
    ///
    /// One beside the defect if the roller is not over it, and then one on the far rim if that is within reach.
    #[inline]
    pub(super) fn contacts_into(&self, distance: f64, offset: f64, found: &mut DefectContacts) {
        let circles = &self.circles;
        found.clear();
        if !within(offset, self.contact_angle) {
            found.push(circles.plain(distance));
            return;
        }
        let (direction, centre) = circles.centre(distance, offset);
        let mirrored = centre.mirrored();
        let (before, after) = (offset < -self.rim.angle, offset >= self.rim.angle);
        if before {
            found.push(circles.plain(distance));
        } else if let Some(mut rim) = self.rim.contact(circles, mirrored) {
            rim.inward = rim.inward.mirrored();
            found.push(self.rim_contact(Feature::RimBefore, &rim, direction));
        }
        if !before
            && !after
            && let Some(contact) = self.floor_contact(centre, mirrored, direction)
        {
            found.push(contact);
        }
        if after {
            found.push(circles.plain(distance));
        } else if let Some(rim) = self.rim.contact(circles, centre) {
            found.push(self.rim_contact(Feature::RimAfter, &rim, direction));
        }
    }

    /// Contact on the floor, if the roller's foot lies where it can touch.
    #[inline]
    fn floor_contact(&self, centre: Vector, mirrored: Vector, direction: Vector) -> Option<DefectContact> {
        let reach = self.reach.as_ref()?;
        let circles = &self.circles;
        if !(reach.holds(centre, circles.sign()) && reach.holds(mirrored, circles.sign())) {
            return None;
        }
        let (t, foot) = self.floor.foot(circles, centre, reach.parameter);
        let inward = foot.inward(circles.side);
        let distance = foot.point.minus(centre).dot(inward);
        let weight =
            if reach.meets_rim { 1.0 } else { self.fade.weight(foot.concavity(circles.side) + self.shortfall) };
        let stiffness = weight * self.stiffness.at(self.floor_curvature(t));
        let delta = circles.roller - distance;
        Some(circles.contact(Feature::Floor, delta, inward, direction, stiffness))
    }

    /// Stiffness on a rim: the carrier's curvature at its outer end; at its inner end zero, or the floor's where
    /// a contact passes on to it.
    #[inline]
    fn rim_contact(&self, feature: Feature, rim: &RimContact, direction: Vector) -> DefectContact {
        let circles = &self.circles;
        let gain = 1.0 / self.rim.radius + circles.carrier_concavity();
        let arc = circles.relative + gain * rim.from_circle;
        let stiffness = if self.reach.as_ref().is_some_and(|reach| reach.meets_rim) {
            let joint = self.joint_curvature;
            self.stiffness.at(joint + (arc - joint) * rim.from_joint)
        } else {
            self.stiffness.at(arc) * rim.from_joint
        };
        circles.contact(feature, rim.delta, rim.inward, direction, stiffness)
    }
}
