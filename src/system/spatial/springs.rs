//! What coordinates meet of the force as springs of their own, and the sizes that a tolerance refers to.

use super::balls::{BallGroup, BearingBalls};
use super::setup::SHAFT;
use super::system::SpatialSystem;
use crate::numerics::lanes::{self, LANES, Lanes, each, together};
use multiversion::multiversion;

/// Of a ball: the stiffness of both contacts along its coordinates over its mass. Shaft and modes have no spring, for they weigh far
/// more. Sizes are the sums of the magnitudes of which the forces are the sums.
#[multiversion(targets("x86_64+avx2+fma", "aarch64+neon"), dispatcher = "direct")]
pub(super) fn find_own_springs(system: &SpatialSystem, springs: &mut [f64], sizes: &mut [f64]) {
    let modes = system.modes;
    let mut first = modes + SHAFT;
    springs[..first].fill(0.0);
    let mut on_shaft = [0.0; SHAFT];
    mode_sizes(system, &mut sizes[..modes]);
    for (bearing, own) in system.bearings.iter().zip(&system.setup.bearings) {
        let last = first + 2 * bearing.count;
        bearing.springs(&mut springs[first..last], &mut sizes[first..last]);
        for (sum, part) in on_shaft.iter_mut().zip(bearing.sizes_on_shaft(own.place.abs())) {
            *sum += part;
        }
        first = last;
    }
    let own = &system.setup.shaft;
    let inertia = [own.mass, own.mass, own.mass, own.transverse_inertia, own.transverse_inertia];
    for (place, (size, inertia)) in on_shaft.into_iter().zip(inertia).enumerate() {
        sizes[modes + place] = size / inertia;
    }
}

impl BearingBalls {
    /// Springs and sizes of the balls, radial and then axial.
    #[inline(always)]
    fn springs(&self, springs: &mut [f64], sizes: &mut [f64]) {
        let mobility = self.mobility;
        let (radial, axial) = springs.split_at_mut(self.count);
        let (radial_size, axial_size) = sizes.split_at_mut(self.count);
        let springs = radial.chunks_mut(LANES).zip(axial.chunks_mut(LANES));
        let sizes = radial_size.chunks_mut(LANES).zip(axial_size.chunks_mut(LANES));
        for ((group, springs), sizes) in self.groups.iter().zip(springs).zip(sizes) {
            let [inner, outer] = [self.inner.springs(&group.inner), self.outer.springs(&group.outer)];
            for (k, (spring, size)) in [(springs.0, sizes.0), (springs.1, sizes.1)].into_iter().enumerate() {
                lanes::put(&together(each(|l| mobility * (inner[k][l] + outer[k][l]))), spring);
                let [inner, outer] = [&group.inner.gradient[k], &group.outer.gradient[k]];
                lanes::put(&together(each(|l| mobility * (inner[l].abs() + outer[l].abs()))), size);
            }
        }
    }

    /// Sums of the magnitudes of the balls' forces on the shaft along x, y and z, and of their moments about x and y, in N and N m, for
    /// a bearing `place` (m) from the centre of mass.
    #[inline(always)]
    fn sizes_on_shaft(&self, place: f64) -> [f64; SHAFT] {
        let sum = |of: &dyn Fn(&BallGroup) -> Lanes| {
            self.groups.iter().fold(0.0, |sum, group| sum + lanes::total(&of(group)))
        };
        let [x, y, z] = [0, 1, 2].map(|k| sum(&|group| each(|l| group.from_inner[k][l].abs())));
        [x, y, z, place * y + self.base * z, place * x + self.base * z]
    }
}

/// Sums of the magnitudes of which the modal forces are the sum.
#[inline(always)]
fn mode_sizes(system: &SpatialSystem, sizes: &mut [f64]) {
    for (number, (out, weight)) in sizes.chunks_mut(LANES).zip(&system.gravity).enumerate() {
        let mut sum = each(|l| weight[l].abs());
        for group in system.bearings.iter().flat_map(|bearing| &bearing.groups) {
            for (force, rows) in group.on_outer.iter().zip(&group.rows) {
                let [a, b, c, d] = &rows[number];
                sum = each(|l| {
                    (sum[l] + (force[0] * a[l]).abs() + (force[1] * b[l]).abs())
                        + ((force[2] * c[l]).abs() + (force[3] * d[l]).abs())
                });
            }
        }
        lanes::put(&together(sum), out);
    }
}
