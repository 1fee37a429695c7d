//! A rigid shaft in its bearings in their housing, at rest where a run in space starts.

use super::bearing::{defects, slip, speed, stiffness};
use super::contacts::{Contact, in_space as contacts_in_space};
use super::damping::{damping, refuse_structural_damping};
use super::doubts::doubts;
use super::spatial::{spatial_bearing, spatial_load};
use super::structure::{CoupledStructure, needed_modes};
use crate::app::case::{self, Case, ContactStiffness, Defect, DentDefect, Preload, Rule, Seat, SpatialCase};
use crate::app::error::ComputeError;
use crate::app::scene::RunModel;
use crate::bearing::kinematics::DefectOrders;
use crate::bearing::spatial::{AcrossGroove, GrooveDefect, SpatialBearing};
use crate::bearing::{Cage, Race};
use crate::fe::model::RingSeat;
use crate::fe::reduction::frf::ModalDamping;
use crate::numerics::Watch;
use crate::numerics::ode::State;
use crate::report::significant;
use crate::system::{
    BallsInertia, BearingInPlace, Formulation, LoadProfile, LoadedModes, ModeSelection, SpatialBallLoad,
    SpatialCondition, SpatialEquilibrium, SpatialLoad, SpatialSetup, SpatialShaft, SpatialSystem, StructureModes,
    Unbalance, with_static_vectors,
};
use nalgebra::Vector2;

/// Instants among which the highest speed of a run is looked for.
const INSTANTS: u32 = 64;

/// Change of an order, relative, that is told: a tooth of a verdict's comb is as wide by the slip that it allows for.
const SPREAD: f64 = 1e-3;

/// How far from one line centres of bearings may be, m, and how far from parallel their axes, rad: what is written in six digits.
const OFF_LINE: f64 = 1e-7;
const OFF_AXIS: f64 = 1e-6;

/// A shaft in its bearings in their housing, and the equilibrium that a simulation starts from.
#[derive(Debug, Clone)]
pub struct MachineScene {
    /// The linear model with its modes.
    pub stage: CoupledStructure,
    /// Shaft, loads and bearings.
    pub setup: SpatialSetup,
    /// Orders of each bearing without slip, at the contact angles in force at the highest speed of the run.
    pub orders: Vec<DefectOrders>,
    /// Damping of the structure's modes.
    pub damping: ModalDamping,
    /// When it starts, s.
    pub start: f64,
    /// Equilibrium with cages and loads as they are then.
    pub equilibrium: SpatialEquilibrium,
    /// What of the model may be meant otherwise, a sentence each.
    pub doubts: Vec<String>,
}

impl MachineScene {
    /// Builds the scene of a case that is looked at from `start` to `end` (s).
    ///
    /// # Errors
    /// [`ComputeError`] of the stages that it goes through.
    pub(crate) fn build(
        run: &SpatialCase<'_>,
        [start, end]: [f64; 2],
        watch: &impl Watch,
    ) -> Result<Self, ComputeError> {
        let case = run.case;
        refuse_structural_damping(case)?;
        for seat in &run.seats {
            refuse_plane_keys(case, seat)?;
        }
        let stage = CoupledStructure::around_rings(case, needed_modes(case), watch)?;
        if let Some(imported) = &stage.bodies.imported {
            imported.refuse_structural_damping()?;
        }
        watch.stage("equilibrium");
        let places = places(case, stage.bodies.rings.seats(), &run.seats)?;
        let mut setup = setup_of(run, &places)?;
        let orders = turn_by_the_angles_in_force(run, [start, end], &stage, &mut setup)?;
        let condition = SpatialCondition::at(&setup, start);
        let equilibrium = SpatialEquilibrium::find(&stage.structure, &setup, &condition)?;
        accept(&run.seats, &setup, &equilibrium, "at rest")?;
        refuse_other_shoulder(case, &run.seats, &setup, &equilibrium)?;
        let mut doubts = doubts(case, stage.bodies.mesh_and_model(), None)?;
        doubts.extend(by_hertz(&run.seats, &setup, &equilibrium).flat_map(|(seat, contacts)| {
            let found = contacts.into_iter().flat_map(|contact| contact.doubts());
            found.map(|doubt| seat.told(doubt)).collect::<Vec<_>>()
        }));
        if equilibrium.directions_down > 0 {
            doubts.push("the equilibrium that the run starts from is not stable: the shaft leaves it at the smallest push; other loads, more preload or another bearing.first_ball_deg start from a stable one".to_owned());
        }
        doubts.extend(starts_in_damage(&setup, start));
        let at_end = SpatialEquilibrium::find(&stage.structure, &setup, &SpatialCondition::at(&setup, end)).ok();
        let ends = [("start", Some(&equilibrium)), ("end", at_end.as_ref())];
        doubts.extend(ends.into_iter().filter_map(|(when, rest)| other_orders(&setup, &orders, rest?, when)));
        Ok(Self { stage, setup, orders, damping: damping(case)?, start, equilibrium, doubts })
    }

    /// The same with a bearing whose grooves are whole.
    pub(crate) fn without_damage(&self, bearing: usize) -> Self {
        let mut scene = self.clone();
        let own = &mut scene.setup.bearings[bearing];
        own.bearing = own.bearing.clone().without_defects();
        scene
    }

    /// The equilibrium, then the others that the loads allow.
    ///
    /// # Errors
    /// [`ComputeError::System`] where nothing rests.
    pub(crate) fn equilibria(&self) -> Result<Vec<SpatialEquilibrium>, ComputeError> {
        let condition = SpatialCondition::at(&self.setup, self.start);
        Ok(SpatialEquilibrium::find_all(&self.stage.structure, &self.setup, &condition)?)
    }

    /// Modes linearised at the equilibrium, of all modes of the structure that are known.
    ///
    /// # Errors
    /// [`ComputeError::System`] if the eigenvalues are not found.
    pub(crate) fn loaded_modes(&self) -> Result<LoadedModes, ComputeError> {
        let modes = &self.stage.modes;
        let (structure, all) = (&self.stage.structure, ModeSelection::Count(modes.count()));
        let system = SpatialSystem::new(structure, modes, self.setup.clone(), all, &self.damping)?;
        let state = system.state_at(self.start, &self.equilibrium, modes);
        Ok(system.loaded_modes(&state)?)
    }

    /// The modes of a model, and with its static residual the vectors that stand for the others.
    ///
    /// # Errors
    /// [`ComputeError::System`] for a structure that nothing holds.
    pub(crate) fn basis(&self, model: &RunModel) -> Result<StructureModes, ComputeError> {
        let (structure, modes) = (&self.stage.structure, &self.stage.modes);
        let kept = model.modes.count(modes);
        let residual = model.residual && kept < structure.dof();
        let kept = if residual { kept } else { return Ok(modes.lowest(kept)) };
        Ok(with_static_vectors(structure, modes, kept, &self.setup)?.0)
    }

    /// A model's system, and where it rests at an instant (s) in its own basis: from elsewhere a run begins with a blow.
    ///
    /// # Errors
    /// [`ComputeError::System`] for a model that does not fit, or where nothing rests.
    pub(crate) fn at_rest(&self, model: &RunModel, time: f64) -> Result<(SpatialSystem, State), ComputeError> {
        let (structure, basis) = (&self.stage.structure, self.basis(model)?);
        let condition = SpatialCondition::at(&self.setup, time);
        let rest = SpatialEquilibrium::in_modes(structure, &basis, &self.setup, &condition)?;
        let system = SpatialSystem::new(structure, &basis, self.setup.clone(), ModeSelection::All, &self.damping)?;
        let state = system.state_at(time, &rest, &basis);
        Ok((system, state))
    }
}

/// The contacts of every bearing whose stiffness is Hertz's: where one is given, grooves and materials do not act.
fn by_hertz<'a>(
    seats: &'a [Seat<'a>],
    setup: &'a SpatialSetup,
    rest: &'a SpatialEquilibrium,
) -> impl Iterator<Item = (&'a Seat<'a>, Vec<Contact>)> {
    let bearings = seats.iter().zip(setup.bearings.iter().zip(&rest.bearings));
    let hertz = |seat: &Seat| seat.bearing.is_some_and(|asked| asked.stiffness == ContactStiffness::Hertz);
    let bearings = bearings.filter(move |(seat, _)| hertz(seat));
    bearings.map(|(seat, (own, balls))| (seat, contacts_in_space(&own.bearing, balls)))
}

/// Refuses contacts that cannot be.
fn accept(seats: &[Seat<'_>], setup: &SpatialSetup, rest: &SpatialEquilibrium, when: &str) -> Result<(), ComputeError> {
    by_hertz(seats, setup, rest)
        .try_for_each(|(seat, contacts)| contacts.iter().try_for_each(|contact| contact.accept(&seat.key(""), when)))
}

/// Refuses a bearing that is pushed against the way in which it holds thrust: it would come apart, and the model has the other shoulder.
fn refuse_other_shoulder(
    case: &Case,
    seats: &[Seat<'_>],
    setup: &SpatialSetup,
    rest: &SpatialEquilibrium,
) -> Result<(), ComputeError> {
    let Some((index, along)) = rest.pushed_apart(setup) else { return Ok(()) };
    let rule = Rule::found(
        format!("{} N of thrust at rest against the way in which the bearing holds it", significant(along, 3)),
        "bearings that hold each other: thrust both ways, or preload above the axial load",
    );
    Err(case.broken(&rule.at(seats[index].key("bearing.thrust"))).into())
}

/// That a ball starts on a defect, a sentence a bearing: the rest that a run begins with is one on whole races.
fn starts_in_damage(setup: &SpatialSetup, start: f64) -> Vec<String> {
    let told = setup.bearings.iter().filter(|own| {
        let cage = own.cage.motion(start).angle;
        let shaft = own.cage.shaft().angle(start);
        let balls = (0..own.bearing.balls()).map(|ball| own.cage.ball_angle(cage, ball as u32));
        let on = |angle: f64| {
            own.bearing.defects().iter().any(|defect| {
                let turned = if defect.race() == Race::Inner { shaft } else { 0.0 };
                defect.profile().contains(angle - turned)
            })
        };
        balls.into_iter().any(on)
    });
    let told = told.map(|own| {
        let name = if own.label.is_empty() { "the bearing".to_owned() } else { format!("bearing {}", own.label) };
        format!("a ball of {name} starts on a defect: it falls into it at the first instant, and the first samples ring; another bearing.first_ball_deg begins beside it")
    });
    told.collect()
}

/// Refuses what of a bearing only the model in the plane knows.
fn refuse_plane_keys(case: &Case, seat: &Seat<'_>) -> Result<(), ComputeError> {
    let Some(bearing) = seat.bearing else { return Ok(()) };
    let given = [
        ("formulation", bearing.formulation != Formulation::Consistent),
        ("balls_inertia", bearing.balls_inertia == Some(BallsInertia::QuasiStatic)),
        ("waviness", !bearing.waviness.is_empty()),
        ("ball_radius_differences", !bearing.ball_radius_differences.is_empty()),
        ("defects", bearing.defects.iter().any(|defect| matches!(defect, Defect::Flat(_)))),
    ];
    match given.into_iter().find(|(_, given)| *given) {
        None => Ok(()),
        Some((key, _)) => {
            let rule = Rule::found(
                "a key of the bearing in its plane",
                "none where the shaft has several bearings, axial load or a contact angle",
            );
            Err(case.broken(&rule.at(seat.key(&format!("bearing.{key}")))).into())
        }
    }
}

/// Places of the bearings along the first one's axis from its centre, m: they have to be on one line, their angles counted alike.
fn places(case: &Case, rings: &[RingSeat], seats: &[Seat<'_>]) -> Result<Vec<f64>, ComputeError> {
    let Some(first) = rings.first() else { return Ok(Vec::new()) };
    let mut places = Vec::with_capacity(rings.len());
    for (ring, seat) in rings.iter().zip(seats) {
        let [x, y, z] = first.frame.point(ring.frame.centre());
        let off = x.hypot(y);
        if off > OFF_LINE {
            let rule = Rule::found(
                format!("a centre {:.3e} m beside the axis of the first bearing", off),
                "one on it: a rigid shaft runs through all bearings",
            );
            return Err(case.broken(&rule.at(seat.key("ring.tie.centre"))).into());
        }
        for (key, local) in [("axis", [0.0, 0.0, 1.0]), ("zero_deg", [1.0, 0.0, 0.0])] {
            let seen = first.frame.vector(ring.frame.vector_to_mesh(local));
            let apart = (0..3).map(|k| (seen[k] - local[k]).powi(2)).sum::<f64>().sqrt();
            if apart > OFF_AXIS {
                let rule = Rule::found("another direction than that of the first bearing", "the same for all bearings");
                return Err(case.broken(&rule.at(seat.key(&format!("ring.tie.{key}")))).into());
            }
        }
        if places.iter().any(|place: &f64| (place - z).abs() <= OFF_LINE) {
            let rule = Rule::found("a centre where another bearing has its own", "a place of its own along the axis");
            return Err(case.broken(&rule.at(seat.key("ring.tie.centre"))).into());
        }
        places.push(z);
    }
    Ok(places)
}

/// Shaft, loads and bearings at these places (m), the cages turning by the free contact angles.
fn setup_of(run: &SpatialCase<'_>, places: &[f64]) -> Result<SpatialSetup, ComputeError> {
    let (case, shaft) = (run.case, run.shaft);
    let centre = shaft.centre.unwrap_or(0.0);
    let of_case = shaft.loads.iter().map(spatial_load);
    let mut loads: Vec<_> = of_case.map(|(at, profile)| SpatialLoad { place: at - centre, profile }).collect();
    let mut bearings = Vec::with_capacity(places.len());
    for (seat, place) in run.seats.iter().zip(places) {
        let Some(asked) = seat.bearing else { continue };
        let bearing = with_defects(case, seat, asked, spatial_bearing(case, asked)?)?;
        let place = place - centre;
        let sign = bearing.thrust().sign();
        let offset = match (asked.preload, run.seats.len()) {
            (None, _) => 0.0,
            (Some(Preload::Force(force)), 1) => {
                let profile = LoadProfile::constant([0.0, 0.0, sign * force, 0.0, 0.0]);
                loads.push(SpatialLoad { place, profile });
                0.0
            }
            (Some(Preload::Displacement(_)), 1) => {
                let rule = Rule::found(
                    "a displacement of the only bearing",
                    "a force: the shaft of a run moves along its axis",
                );
                return Err(case.broken(&rule.at(seat.key("bearing.preload"))).into());
            }
            (Some(Preload::Displacement(displacement)), _) => -sign * displacement,
            (Some(Preload::Force(force)), _) => {
                -bearing.axial_displacement(force).map_err(ComputeError::bearing(seat.key("bearing.preload: ")))?
            }
        };
        let geometry = *bearing.geometry();
        let free = asked.contact_angle_deg.map_or(0.0, f64::to_radians);
        let cage = 0.5 * (1.0 - geometry.diameter_ratio() * free.cos());
        bearings.push(BearingInPlace {
            label: seat.label.clone(),
            cage: cage_of(case, seat, asked, &bearing, cage)?,
            bearing,
            place,
            offset,
            contact_damping: asked.contact_damping,
        });
    }
    let own = (shaft.unbalance > 0.0).then_some(Unbalance { moment: shaft.unbalance, angle: 0.0, place: 0.0 });
    let others = shaft.unbalances.iter().map(|asked| Unbalance {
        moment: asked.moment,
        angle: asked.angle_deg.to_radians(),
        place: asked.at - centre,
    });
    let [gx, gy] = shaft.gravity;
    Ok(SpatialSetup {
        shaft: SpatialShaft {
            mass: shaft.mass,
            transverse_inertia: run.transverse_inertia,
            polar_inertia: shaft.polar_inertia.unwrap_or(0.0),
            unbalances: own.into_iter().chain(others).collect(),
            loads,
        },
        bearings,
        gravity: [gx, gy, 0.0],
    })
}

/// A bearing with the dents and profiles that its grooves have.
fn with_defects(
    case: &Case,
    seat: &Seat<'_>,
    asked: &case::Bearing,
    bearing: SpatialBearing,
) -> Result<SpatialBearing, ComputeError> {
    let geometry = *bearing.geometry();
    let (profiles, _) = defects(&asked.defects, &geometry, stiffness(case, asked, &geometry)?)?;
    let across = asked.defects.iter().map(|defect| match defect {
        Defect::Dent(DentDefect { across: Some(place), width: Some(width), .. }) => {
            Some(AcrossGroove { place: *place, width: *width })
        }
        // under the balls, whatever their contact angle
        _ => None,
    });
    let defects = profiles.into_iter().zip(across).map(|(profile, across)| GrooveDefect { profile, across });
    bearing.with_defects(defects.collect()).map_err(ComputeError::bearing(seat.key("bearing.defects: ")))
}

/// The cage of a bearing that without slip turns so many times in a turn of the shaft.
fn cage_of(
    case: &Case,
    seat: &Seat<'_>,
    asked: &case::Bearing,
    bearing: &SpatialBearing,
    rolling_ratio: f64,
) -> Result<Cage, ComputeError> {
    let (balls, first) = (bearing.geometry().balls(), asked.first_ball_deg.to_radians());
    Cage::rolling(rolling_ratio, balls, speed(case)?, slip(&asked.slip)?, first)
        .map_err(ComputeError::bearing(seat.key("bearing: ")))
}

/// Lets the cages turn by the contact angles in force at the highest speed of the run, the mean over the balls by their loads; gives
/// the orders. The angles depend on the speed, through the centrifugal force, far less than on preload and thrust.
fn turn_by_the_angles_in_force(
    run: &SpatialCase<'_>,
    [start, end]: [f64; 2],
    stage: &CoupledStructure,
    setup: &mut SpatialSetup,
) -> Result<Vec<DefectOrders>, ComputeError> {
    let shaft = setup.bearings[0].cage.shaft().clone();
    let at = |k: u32| start + (end - start) * f64::from(k) / f64::from(INSTANTS);
    let instants = (0..=INSTANTS).map(at);
    let speed = |time: f64| shaft.motion(time).speed.abs();
    let fastest = instants.fold(start, |best, t| if speed(t) > speed(best) { t } else { best });
    let condition = SpatialCondition::at(setup, fastest);
    let equilibrium = SpatialEquilibrium::find(&stage.structure, setup, &condition)?;
    accept(&run.seats, setup, &equilibrium, "at the highest speed")?;
    let mut orders = Vec::with_capacity(setup.bearings.len());
    for ((own, seat), balls) in setup.bearings.iter_mut().zip(&run.seats).zip(&equilibrium.bearings) {
        let Some(asked) = seat.bearing else { continue };
        let geometry = *own.bearing.geometry();
        let ratio = cage_ratio(&own.bearing, balls);
        if let Some(ratio) = ratio {
            own.cage = cage_of(run.case, seat, asked, &own.bearing, ratio)?;
        }
        let free = 0.5 * (1.0 - geometry.diameter_ratio());
        orders.push(DefectOrders::of_cage(
            f64::from(geometry.balls()),
            geometry.diameter_ratio(),
            ratio.unwrap_or(free),
        ));
    }
    Ok(orders)
}

/// That the contact angles at one end of the run make other orders, of the bearing where they differ most.
fn other_orders(
    setup: &SpatialSetup,
    orders: &[DefectOrders],
    rest: &SpatialEquilibrium,
    when: &str,
) -> Option<String> {
    let mut most = (0.0_f64, "", "", 0.0, 0.0);
    for ((own, taken), balls) in setup.bearings.iter().zip(orders).zip(&rest.bearings) {
        let Some(ratio) = cage_ratio(&own.bearing, balls) else { continue };
        let geometry = own.bearing.geometry();
        let there = DefectOrders::of_cage(f64::from(geometry.balls()), geometry.diameter_ratio(), ratio);
        for (line, taken, there) in [("BPFO", taken.outer, there.outer), ("BPFI", taken.inner, there.inner)] {
            let change = there / taken - 1.0;
            if change.abs() > most.0.abs() {
                most = (change, &own.label, line, taken, there);
            }
        }
    }
    let (change, label, line, taken, there) = most;
    (change.abs() > SPREAD).then(|| {
        format!(
            "{}: cage and verdicts go by the contact angles at the highest speed, {line} {}; those at the {when} of the run make it {}, {} % {}: on a machine its lines smear by so much, in these signals they do not",
            if label.is_empty() { "the bearing".to_owned() } else { format!("bearing {label}") },
            significant(taken, 5),
            significant(there, 5),
            significant(100.0 * change.abs(), 2),
            if change > 0.0 { "more" } else { "less" }
        )
    })
}

/// Turns of the cage in a turn of the shaft: the mean of the balls' rolling, by their loads; `None` where no ball is loaded.
fn cage_ratio(bearing: &SpatialBearing, balls: &[SpatialBallLoad]) -> Option<f64> {
    let along = |angle: f64| Vector2::new(angle.cos(), angle.sin());
    let (mut sum, mut loads) = (0.0, 0.0);
    for ball in balls {
        let [Some(inner), Some(outer)] = ball.contact_angle else { continue };
        let load = 0.5 * (ball.load[0] + ball.load[1]);
        sum += load * bearing.law().speeds(along(inner), along(outer), 1.0).orbit;
        loads += load;
    }
    (loads > 0.0).then(|| sum / loads)
}
