//! Where structure, shaft and balls of several bearings rest: the minimum of one potential.
//!
//! Unknowns: the shaft's five displacements (tilts times a length), and for every ball its place and the displacement of the outer
//! groove's centre under it, radial and axial. The structure's potential is that of its static flexibility G at the grooves,
//! `(r - w) . G^-1 (r - w) / 2`, w its displacement under its weight. Friction by gyroscopic moments has no potential: it is held
//! while the search runs, and found again until it stays.

use super::pose::Pose;
use super::setup::{SHAFT, SpatialSetup};
use crate::bearing::BearingError;
use crate::bearing::spatial::{
    Axis, GrooveContact, InnerFrame, MountedBearing, RigidShaft, RingDisplacement, ShaftLoad, Thrust,
};
use crate::numerics::linalg::DenseMatrix;
use crate::system::equilibrium::{Evaluation, Found, HELD, Potential, Search};
use crate::system::{Pressed, Structure, StructureModes, SystemError};
use nalgebra::{DMatrix, DVector, SMatrix, Vector2, Vector3};

/// Unknowns of a ball: its place, and that of the outer groove's centre under it.
const OF_BALL: usize = 4;

/// What every groove gives way by itself at least, in units of the largest flexibility: few modes do not move all grooves. A micrometre
/// under a load becomes 1 + 1e-9 of it.
const LEAST_FLEXIBILITY: f64 = 1e-9;

/// Rounds of friction at most, and the change of it, relative to the largest load on a ball, that ends them.
const ROUNDS: usize = 50;
const FRICTION_TOLERANCE: f64 = 1e-12;

/// A ball at rest. Pairs are of the inner and the outer race.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpatialBallLoad {
    /// Azimuth, rad.
    pub azimuth: f64,
    /// Radial and axial place from the outer groove's centre at rest, m.
    pub place: [f64; 2],
    /// Normal force, N.
    pub load: [f64; 2],
    /// Contact angle, rad, positive where the inner ring is pushed along +z; `None` without contact.
    pub contact_angle: [Option<f64>; 2],
}

/// Where everything rests.
#[derive(Debug, Clone, PartialEq)]
pub struct SpatialEquilibrium {
    /// Displacement of the shaft's centre of mass along x, y, z (m) and its tilts about x and y (rad).
    pub shaft: [f64; 5],
    /// The balls of each bearing.
    pub bearings: Vec<Vec<SpatialBallLoad>>,
    /// Contact forces and weight on the structure's coordinates \[dof\].
    pub structure_load: Vec<f64>,
    /// Newton iterations.
    pub iterations: usize,
    /// Largest force out of balance, N; moments over the pitch radius.
    pub residual_n: f64,
    /// Directions in which the potential falls: none in a stable equilibrium.
    pub directions_down: usize,
    /// Stiffness that a further load on the shaft meets, balls and structure following, by x, y, z (m) and the tilts (rad).
    pub shaft_stiffness: [[f64; 5]; 5],
}

/// Loads, cages and shaft as they stand still.
#[derive(Debug, Clone, PartialEq)]
pub struct SpatialCondition {
    /// When, s.
    pub time: f64,
    /// Angle of ball 0 of each bearing, rad.
    pub cage_angles: Vec<f64>,
    /// Speed of each cage, rad/s.
    pub cage_speeds: Vec<f64>,
}

impl SpatialCondition {
    /// As they are at `time` (s); the rotating unbalance is not included.
    pub(crate) fn at(setup: &SpatialSetup, time: f64) -> Self {
        let motions: Vec<_> = setup.bearings.iter().map(|own| own.cage.motion(time)).collect();
        Self {
            time,
            cage_angles: motions.iter().map(|motion| motion.angle).collect(),
            cage_speeds: motions.iter().map(|motion| motion.speed).collect(),
        }
    }
}

/// The potential.
pub(super) struct Problem<'a> {
    setup: &'a SpatialSetup,
    condition: &'a SpatialCondition,
    /// Bearing, cosine and sine of the azimuth, and the azimuth of each ball.
    balls: Vec<(usize, [f64; 2], f64)>,
    /// G^-1 [2 balls x 2 balls], N/m.
    stiffness: DMatrix<f64>,
    /// Displacement under the structure's weight [2 balls], m.
    weight: DVector<f64>,
    /// Friction on each coordinate, N.
    pub friction: DVector<f64>,
    /// What tilts are multiplied with, m.
    arm: f64,
}

/// Normal forces and angles of a ball, as [`SpatialBallLoad`] has them.
pub(super) type Contacts = Vec<([f64; 2], [Option<f64>; 2])>;

impl SpatialEquilibrium {
    /// Finds where the loads lead from the rest of the same shaft in rigid outer rings.
    ///
    /// # Errors
    /// [`SystemError::NoEquilibrium`]; [`SystemError::Refused`] for a structure that nothing holds.
    pub fn find(
        structure: &Structure,
        setup: &SpatialSetup,
        condition: &SpatialCondition,
    ) -> Result<Self, SystemError> {
        Self::by(structure, setup, condition, 0.0, |loads| structure.static_response(loads))
    }

    /// The same of a structure that gives way in these modes alone: where a system of these modes rests.
    ///
    /// # Errors
    /// As [`find`](Self::find).
    pub(crate) fn in_modes(
        structure: &Structure,
        modes: &StructureModes,
        setup: &SpatialSetup,
        condition: &SpatialCondition,
    ) -> Result<Self, SystemError> {
        let shapes = &modes.shapes;
        Self::by(structure, setup, condition, LEAST_FLEXIBILITY, |loads| {
            let mut amplitudes = shapes.transpose() * loads;
            for column in 0..amplitudes.ncols() {
                for (amplitude, square) in
                    amplitudes.col_as_slice_mut(column).iter_mut().zip(&modes.squared_frequencies)
                {
                    *amplitude /= square;
                }
            }
            Ok(shapes * amplitudes)
        })
    }

    fn by(
        structure: &Structure,
        setup: &SpatialSetup,
        condition: &SpatialCondition,
        least: f64,
        response: impl Fn(&DenseMatrix) -> Result<DenseMatrix, SystemError>,
    ) -> Result<Self, SystemError> {
        let (mut problem, loads, flexibility) = Problem::new(structure, setup, condition, least, response)?;
        let start = problem.start(&problem.rest_in_rigid_rings(), &flexibility);
        let found = problem.settled(start)?;
        Ok(problem.result(&found, &loads))
    }

    /// Whether every displacement from it that a contact or the structure feels needs work.
    pub(crate) fn is_stable(&self) -> bool {
        self.directions_down == 0
    }

    /// A bearing that is pushed against the way in which it holds thrust, and by how much (N).
    pub(crate) fn pushed_apart(&self, setup: &SpatialSetup) -> Option<(usize, f64)> {
        let bearings = self.bearings.iter().zip(&setup.bearings).enumerate();
        let mut pushed = bearings.filter_map(|(index, (balls, own))| {
            let along: f64 = balls.iter().map(|ball| ball.load[0] * ball.contact_angle[0].unwrap_or(0.0).sin()).sum();
            let thrust = own.bearing.thrust();
            (thrust != Thrust::Both && along * thrust.sign() < 0.0).then_some((index, along.abs()))
        });
        pushed.next()
    }
}

impl<'a> Problem<'a> {
    /// The problem, the loads behind it (unit forces at the grooves, then the weight [dof x 2 balls + 1]) and the flexibility there.
    pub(super) fn new(
        structure: &Structure,
        setup: &'a SpatialSetup,
        condition: &'a SpatialCondition,
        least: f64,
        response: impl Fn(&DenseMatrix) -> Result<DenseMatrix, SystemError>,
    ) -> Result<(Self, DenseMatrix, DMatrix<f64>), SystemError> {
        let mut balls = Vec::new();
        for (index, own) in setup.bearings.iter().enumerate() {
            for ball in 0..own.bearing.balls() {
                let azimuth = own.cage.ball_angle(condition.cage_angles[index], ball as u32);
                balls.push((index, [azimuth.cos(), azimuth.sin()], azimuth));
            }
        }
        let count = balls.len();
        let mut loads = DenseMatrix::zeros(structure.dof(), 2 * count + 1);
        for (place, &(index, _, azimuth)) in balls.iter().enumerate() {
            let seat = &structure.rings().seats()[index];
            let law = setup.bearings[index].bearing.law();
            let Some(rows) = seat.ring.space_rows_at(azimuth) else {
                return Err(SystemError::Refused("a bearing in space needs a ring in space"));
            };
            let arm = law.grooves.outer_centres - seat.ring.section().radius;
            let [radial, _, axial] = rows.displacement_at(arm, 0.0);
            for (k, dof) in rows.dofs.into_iter().enumerate() {
                loads[(seat.first + dof, 2 * place)] += radial[k];
                loads[(seat.first + dof, 2 * place + 1)] += axial[k];
            }
        }
        for (row, weight) in structure.gravity().iter().enumerate() {
            loads[(row, 2 * count)] = *weight;
        }
        let responses = response(&loads)?;
        let at_grooves = loads.subcols(0, 2 * count).transpose() * &responses;
        let largest = (0..2 * count).map(|k| at_grooves[(k, k)]).fold(0.0, f64::max);
        let least = least * largest;
        let flexibility = DMatrix::from_fn(2 * count, 2 * count, |i, j| {
            0.5 * (at_grooves[(i, j)] + at_grooves[(j, i)]) + if i == j { least } else { 0.0 }
        });
        let stiffness = flexibility.clone().cholesky().ok_or(SystemError::Refused(
            "the structure does not give way at some balls: give the rings more nodes, or sections that are less stiff",
        ))?;
        let pitch = setup.bearings.iter().map(|own| own.bearing.geometry().pitch_radius());
        let problem = Self {
            setup,
            condition,
            stiffness: stiffness.inverse(),
            weight: DVector::from_fn(2 * count, |i, _| at_grooves[(i, 2 * count)]),
            friction: DVector::zeros(SHAFT + OF_BALL * count),
            arm: pitch.fold(0.0, f64::max),
            balls,
        };
        Ok((problem, loads, flexibility))
    }

    /// The shaft's displacement.
    fn displacement(&self, z: &DVector<f64>) -> RingDisplacement {
        RingDisplacement { translation: [z[0], z[1], z[2]], tilt: [z[3] / self.arm, z[4] / self.arm] }
    }

    /// Generalised load on the shaft, tilts as the unknowns have them, N.
    fn load(&self, shaft: &RingDisplacement) -> [f64; 5] {
        let [x, y, z] = shaft.translation;
        let pose = Pose::new(&[x, y, z, shaft.tilt[0], shaft.tilt[1]]);
        let [x, y, z, a, b] = self.setup.shaft_load(&pose, self.condition.time);
        [x, y, z, a / self.arm, b / self.arm]
    }

    /// The same of the undisplaced shaft.
    pub(super) fn load_at_rest(&self) -> [f64; 5] {
        self.load(&RingDisplacement::default())
    }

    fn frame_of(&self, index: usize, shaft: &RingDisplacement, axis: &Axis) -> InnerFrame {
        let own = &self.setup.bearings[index];
        let [dx, dy, dz]: [f64; 3] = axis.moved(own.place).into();
        let [x, y, z] = shaft.translation;
        InnerFrame::new(&RingDisplacement { translation: [x + dx, y + dy, z + dz - own.offset], tilt: shaft.tilt })
    }

    /// Goes downhill from a start until the friction stays.
    pub(super) fn settled(&mut self, start: DVector<f64>) -> Result<Found<Contacts>, SystemError> {
        self.friction.fill(0.0);
        let mut found = self.search(start, true)?;
        let mut iterations = found.iterations;
        for _ in 0..ROUNDS {
            let friction = self.friction_at(&found.z);
            let change = (&friction - &self.friction).amax();
            self.friction = friction;
            if change <= FRICTION_TOLERANCE * self.force_scale() {
                break;
            }
            found = self.search(found.z, true)?;
            iterations += found.iterations;
        }
        Ok(Found { iterations, ..found })
    }

    /// The same shaft in rigid outer rings, with its load.
    ///
    /// # Errors
    /// [`BearingError`] as of [`RigidShaft::new`].
    pub(super) fn in_rigid_rings(&self) -> Result<(RigidShaft, ShaftLoad), BearingError> {
        let mounted = self.setup.bearings.iter().zip(&self.condition.cage_angles).map(|(own, &cage_angle)| {
            MountedBearing { bearing: own.bearing.clone(), place: own.place, offset: own.offset, cage_angle }
        });
        let [x, y, z, a, b] = self.load_at_rest();
        let load = ShaftLoad { force: [x, y, z], moment: [a * self.arm, b * self.arm], place: 0.0 };
        Ok((RigidShaft::new(mounted.collect(), 0.0)?, load))
    }

    /// Where that rests; its undisplaced place where it does not.
    pub(super) fn rest_in_rigid_rings(&self) -> RingDisplacement {
        let rest = self.in_rigid_rings().and_then(|(shaft, load)| shaft.equilibrium(&load));
        rest.map_or_else(|_| RingDisplacement::default(), |found| found.displacement)
    }

    /// A displacement in rigid rings, moved on with the structure; balls that touch the outer race where there is none.
    pub(super) fn start(&self, displacement: &RingDisplacement, flexibility: &DMatrix<f64>) -> DVector<f64> {
        let axis = Axis::new(displacement);
        let mut unknowns = DVector::zeros(SHAFT + OF_BALL * self.balls.len());
        let mut forces = DVector::zeros(2 * self.balls.len());
        for (place, &(index, direction, _)) in self.balls.iter().enumerate() {
            let law = self.setup.bearings[index].bearing.law();
            let plane = self.frame_of(index, displacement, &axis).plane(direction, law.grooves.outer_centres);
            let touching = law.grooves.seats[1] / law.grooves.centre_distance;
            let free = Vector2::new(law.grooves.radial_gap, law.grooves.axial_gap) * touching;
            let at = law.place(&plane, 0.0).unwrap_or(free);
            let outer = law.outer.at(at);
            for axis in 0..2 {
                unknowns[SHAFT + OF_BALL * place + axis] = at[axis];
                forces[2 * place + axis] = outer.gradient[axis];
            }
        }
        let moved = &self.weight + flexibility * forces;
        let shift = self.rigid_part(&moved);
        for (axis, value) in displacement.vector().iter().enumerate() {
            let scale = if axis < 3 { 1.0 } else { self.arm };
            unknowns[axis] = scale * value + shift[axis];
        }
        for place in 0..self.balls.len() {
            for axis in 0..2 {
                unknowns[SHAFT + OF_BALL * place + axis] += moved[2 * place + axis];
                unknowns[SHAFT + OF_BALL * place + 2 + axis] = moved[2 * place + axis];
            }
        }
        unknowns
    }

    /// The shaft's displacement that follows displacements of the grooves best, tilts times the length.
    fn rigid_part(&self, moved: &DVector<f64>) -> DVector<f64> {
        let row = |k: usize| {
            let (index, [cos, sin], _) = self.balls[k / 2];
            let (place, radius) = (self.setup.bearings[index].place, self.arm);
            match k % 2 {
                0 => [cos, sin, 0.0, -place * sin / radius, place * cos / radius],
                _ => [0.0, 0.0, 1.0, sin, -cos],
            }
        };
        let rows = DMatrix::from_fn(moved.len(), SHAFT, |k, column| row(k)[column]);
        rows.svd(true, true).solve(moved, 1e-9).unwrap_or_else(|_| DVector::zeros(SHAFT))
    }

    /// Friction by the gyroscopic moments of the balls where they are.
    pub(super) fn friction_at(&self, z: &DVector<f64>) -> DVector<f64> {
        let mut friction = DVector::zeros(z.len());
        let shaft = self.displacement(z);
        let axis = Axis::new(&shaft);
        for (place, &(index, direction, _)) in self.balls.iter().enumerate() {
            let own = &self.setup.bearings[index];
            let law = own.bearing.law();
            let speed = self.condition.cage_speeds[index];
            let first = SHAFT + OF_BALL * place;
            let u = Vector2::new(z[first], z[first + 1]);
            let outer = law.outer.at(u - Vector2::new(z[first + 2], z[first + 3]));
            let frame = self.frame_of(index, &shaft, &axis);
            let plane = frame.plane(direction, law.grooves.outer_centres);
            let gap = Vector2::new(law.grooves.radial_gap, law.grooves.axial_gap);
            let inner = law.inner.at(plane.seen(u).place - gap);
            let factor = 0.1 * law.mass * law.diameter * law.pitch_diameter * speed * speed * outer.direction.y;
            let [l_i, l_o] = law.race_control.shares().map(|share| share / law.diameter);
            if outer.penetration > 0.0 {
                let own = l_o * factor * Vector2::new(outer.direction.y, -outer.direction.x);
                for axis in 0..2 {
                    friction[first + axis] += own[axis];
                    friction[first + 2 + axis] -= own[axis];
                }
            }
            if inner.penetration > 0.0 && l_i > 0.0 {
                let own = l_i * factor * Vector2::new(-inner.direction.y, inner.direction.x);
                let all = frame.seen_by_all(&plane, u);
                let by_all = all.slope.transpose() * own;
                let follow = axis.follow(self.setup.bearings[index].place);
                let on_shaft = follow.transpose() * by_all.fixed_rows::<5>(0);
                for k in 0..SHAFT {
                    friction[k] += on_shaft[k] / if k < 3 { 1.0 } else { self.arm };
                }
                friction[first] += by_all[5];
                friction[first + 1] += by_all[6];
            }
        }
        friction
    }

    /// The equilibrium that a search found; `loads` as [`Problem::new`] gives them.
    pub(super) fn result(&self, found: &Found<Contacts>, loads: &DenseMatrix) -> SpatialEquilibrium {
        let (z, count) = (&found.z, self.balls.len());
        // what holds the structure is what the contacts and the friction do to the grooves
        let moved = DVector::from_fn(2 * count, |k, _| z[SHAFT + OF_BALL * (k / 2) + 2 + k % 2] - self.weight[k]);
        let forces = &self.stiffness * moved;
        let structure_load = (0..loads.nrows())
            .map(|row| (0..2 * count).map(|k| loads[(row, k)] * forces[k]).sum::<f64>() + loads[(row, 2 * count)]);
        let mut bearings: Vec<Vec<SpatialBallLoad>> = vec![Vec::new(); self.setup.bearings.len()];
        for (place, &(index, _, azimuth)) in self.balls.iter().enumerate() {
            let (load, contact_angle) = found.evaluation.contacts[place];
            let first = SHAFT + OF_BALL * place;
            bearings[index].push(SpatialBallLoad { azimuth, place: [z[first], z[first + 1]], load, contact_angle });
        }
        let shaft = self.displacement(z).vector();
        SpatialEquilibrium {
            shaft: shaft.into(),
            bearings,
            structure_load: structure_load.collect(),
            iterations: found.iterations,
            residual_n: found.evaluation.gradient.amax(),
            directions_down: found.directions_down,
            shaft_stiffness: self.shaft_stiffness(&found.evaluation.hessian),
        }
    }

    /// `H_ss - H_sb H_bb^-1 H_bs` with s the shaft and b all else; what nothing holds does not take part.
    fn shaft_stiffness(&self, hessian: &DMatrix<f64>) -> [[f64; 5]; 5] {
        let rest = hessian.nrows() - SHAFT;
        let of_rest = hessian.view((SHAFT, SHAFT), (rest, rest)).symmetric_eigen();
        let coupling = of_rest.eigenvectors.transpose() * hessian.view((SHAFT, 0), (rest, SHAFT));
        let scale = |k: usize| if k < 3 { 1.0 } else { self.arm };
        std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                let through = of_rest.eigenvalues.iter().enumerate().filter(|(_, curvature)| curvature.abs() > HELD);
                let through = through.map(|(mode, curvature)| coupling[(mode, i)] * coupling[(mode, j)] / curvature);
                (hessian[(i, j)] - through.sum::<f64>()) * scale(i) * scale(j)
            })
        })
    }
}

impl Potential for Problem<'_> {
    type Contacts = Contacts;

    fn evaluate(&mut self, z: &DVector<f64>) -> Evaluation<Contacts> {
        let count = self.balls.len();
        let order = SHAFT + OF_BALL * count;
        let shaft = self.displacement(z);
        let axis = Axis::new(&shaft);
        let mut gradient = -&self.friction;
        let mut hessian = DMatrix::zeros(order, order);
        for (k, load) in self.load(&shaft).into_iter().enumerate() {
            gradient[k] -= load;
        }
        let scale = SMatrix::<f64, 5, 5>::from_diagonal(&[1.0, 1.0, 1.0, 1.0 / self.arm, 1.0 / self.arm].into());
        for load in &self.setup.shaft.loads {
            let [x, y, force, ..] = load.profile.at(self.condition.time);
            let turned = scale * axis.turning(load.place, Vector3::new(x, y, force)) * scale;
            add(&mut hessian, [0, 0], &-turned);
        }
        let mut contacts = Vec::with_capacity(count);
        let frames: Vec<InnerFrame> =
            (0..self.setup.bearings.len()).map(|index| self.frame_of(index, &shaft, &axis)).collect();
        let gravity = self.setup.gravity;
        for (place, &(index, direction, _)) in self.balls.iter().enumerate() {
            let own = &self.setup.bearings[index];
            let law = own.bearing.law();
            let first = SHAFT + OF_BALL * place;
            let u = Vector2::new(z[first], z[first + 1]);
            let plane = frames[index].plane(direction, law.grooves.outer_centres);
            let gap = Vector2::new(law.grooves.radial_gap, law.grooves.axial_gap);
            let inner = law.inner.at(plane.seen(u).place - gap);
            if inner.load > 0.0 {
                let all = frames[index].seen_by_all(&plane, u);
                let slope = all.slope.transpose() * inner.gradient;
                let curvature = all.slope.transpose() * inner.hessian * all.slope
                    + inner.gradient.x * all.bend[0]
                    + inner.gradient.y * all.bend[1];
                let follow = axis.follow(own.place) * scale;
                let on_shaft = follow.transpose() * slope.fixed_rows::<5>(0);
                for k in 0..SHAFT {
                    gradient[k] += on_shaft[k];
                }
                let force = Vector3::new(slope[0], slope[1], slope[2]);
                let own_turn = scale * axis.turning(own.place, force) * scale;
                add(
                    &mut hessian,
                    [0, 0],
                    &(follow.transpose() * curvature.fixed_view::<5, 5>(0, 0) * follow + own_turn),
                );
                let cross = follow.transpose() * curvature.fixed_view::<5, 2>(0, 5);
                add(&mut hessian, [0, first], &cross);
                add(&mut hessian, [first, 0], &cross.transpose());
                add(&mut hessian, [first, first], &curvature.fixed_view::<2, 2>(5, 5).into_owned());
                gradient[first] += slope[5];
                gradient[first + 1] += slope[6];
            }
            let outer = law.outer.at(u - Vector2::new(z[first + 2], z[first + 3]));
            for (start, sign) in [(first, 1.0), (first + 2, -1.0)] {
                gradient[start] += sign * outer.gradient.x;
                gradient[start + 1] += sign * outer.gradient.y;
                for (other, with) in [(first, 1.0), (first + 2, -1.0)] {
                    add(&mut hessian, [start, other], &(outer.hessian * (sign * with)));
                }
            }
            let square = self.condition.cage_speeds[index].powi(2);
            let weight = law.mass * (gravity[0] * direction[0] + gravity[1] * direction[1]);
            gradient[first] -= law.mass * square * (law.grooves.outer_centres + u.x) + weight;
            gradient[first + 1] -= law.mass * gravity[2];
            hessian[(first, first)] -= law.mass * square;
            contacts.push(([inner.load, outer.load], [inner.force_angle(), outer.force_angle()]));
        }
        let moved = DVector::from_fn(2 * count, |k, _| z[SHAFT + OF_BALL * (k / 2) + 2 + k % 2] - self.weight[k]);
        let held = &self.stiffness * moved;
        let at = |k: usize| SHAFT + OF_BALL * (k / 2) + 2 + k % 2;
        for i in 0..2 * count {
            gradient[at(i)] += held[i];
            for j in 0..2 * count {
                hessian[(at(i), at(j))] += self.stiffness[(i, j)];
            }
        }
        let hessian = (&hessian + hessian.transpose()) * 0.5;
        Evaluation { gradient, hessian, contacts }
    }

    fn force_scale(&self) -> f64 {
        let load = self.load_at_rest();
        let balls = self.setup.bearings.iter().map(|own| own.bearing.law().mass * 9.81);
        load.iter().map(|part| part * part).sum::<f64>().sqrt().max(balls.fold(0.0, f64::max))
    }

    fn touching_radius(&self) -> f64 {
        self.arm
    }

    fn pressed(&self) -> Pressed {
        let start = Pressed { load_n: self.force_scale(), stiffness: f64::INFINITY, limit_m: f64::INFINITY };
        self.setup.bearings.iter().fold(start, |least, own| {
            let law = own.bearing.law();
            let of_race = |groove: &GrooveContact| groove.stiffness.at(1.0)[0].powf(-2.0 / 3.0);
            let stiffness = (of_race(&law.inner) + of_race(&law.outer)).powf(-1.5);
            let (stiffness, limit_m) = (least.stiffness.min(stiffness), least.limit_m.min(0.25 * law.diameter));
            Pressed { stiffness, limit_m, ..least }
        })
    }
}

/// Adds a small matrix at a place of a large one.
fn add<const R: usize, const C: usize>(to: &mut DMatrix<f64>, [row, column]: [usize; 2], part: &SMatrix<f64, R, C>) {
    let mut view = to.fixed_view_mut::<R, C>(row, column);
    view += part;
}
