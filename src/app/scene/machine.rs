//! A rigid shaft in its bearings in their housing, at rest where a run in space starts.

use super::bearing::{defects, slip, speed, stiffness};
use super::contact_damping::PressedBall;
use super::damping::{damping, refuse_structural_damping};
use super::doubts::doubts;
use super::machine_checks::{
    accept, by_hertz, nothing_rests, other_orders, refuse_other_shoulder, refuse_plane_keys, starts_in_damage,
};
use super::spatial::{offset, places, spatial_bearing, spatial_load};
use super::structure::{CoupledStructure, needed_modes};
use crate::app::case::{self, Case, Defect, DentDefect, Preload, Rule, Seat, SpatialCase};
use crate::app::error::ComputeError;
use crate::app::scene::RunModel;
use crate::bearing::kinematics::DefectOrders;
use crate::bearing::spatial::{AcrossGroove, GrooveDefect, SpatialBearing};
use crate::bearing::{BearingError, Cage, Race, RatingLife};
use crate::fe::model::RingFrame;
use crate::fe::reduction::frf::ModalDamping;
use crate::numerics::Watch;
use crate::numerics::ode::State;
use crate::system::{
    BearingInPlace, LoadProfile, LoadedModes, ModeSelection, SpatialBallLoad, SpatialCondition, SpatialEquilibrium,
    SpatialLoad, SpatialSetup, SpatialShaft, SpatialSystem, StructureModes, SystemError, Unbalance,
    with_static_vectors,
};
use nalgebra::Vector2;
use std::sync::Arc;

/// Rounds of cage and contact angles, which make each other at high speed, and the change of the cage's order that ends them, relative.
const ROUNDS: usize = 20;
const SETTLED: f64 = 1e-6;

/// A shaft in its bearings in their housing, and the equilibrium that a simulation starts from.
#[derive(Debug, Clone)]
pub struct MachineScene {
    /// The linear model with its modes.
    pub stage: Arc<CoupledStructure>,
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
    pub(crate) fn build(run: &SpatialCase<'_>, span: [f64; 2], watch: &impl Watch) -> Result<Self, ComputeError> {
        Self::with_modes(run, span, needed_modes(run.case), watch)
    }

    /// The same with all modes of its structure, however many.
    ///
    /// # Errors
    /// As [`build`](Self::build).
    pub(crate) fn with_all_modes(
        run: &SpatialCase<'_>,
        span: [f64; 2],
        watch: &impl Watch,
    ) -> Result<Self, ComputeError> {
        Self::with_modes(run, span, usize::MAX, watch)
    }

    fn with_modes(
        run: &SpatialCase<'_>,
        span: [f64; 2],
        count: usize,
        watch: &impl Watch,
    ) -> Result<Self, ComputeError> {
        refuse_structural_damping(run.case)?;
        // before the housing is condensed
        run.seats.iter().try_for_each(|seat| refuse_plane_keys(run.case, seat))?;
        let stage = CoupledStructure::around_rings(run.case, count, watch)?;
        watch.stage("equilibrium");
        Self::around(stage.into(), run, span)
    }

    /// The scene of a case around rings and housing that are built already, of a case that has the same.
    ///
    /// # Errors
    /// As [`build`](Self::build).
    pub(crate) fn around(
        stage: Arc<CoupledStructure>,
        run: &SpatialCase<'_>,
        [start, end]: [f64; 2],
    ) -> Result<Self, ComputeError> {
        let case = run.case;
        run.seats.iter().try_for_each(|seat| refuse_plane_keys(case, seat))?;
        if let Some(imported) = &stage.bodies.imported {
            imported.refuse_structural_damping()?;
        }
        let frames: Vec<RingFrame> = stage.bodies.rings.seats().iter().map(|seat| seat.frame).collect();
        let places = places(case, &frames, &run.seats)?;
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
        doubts.extend(
            ends.into_iter().filter_map(|(when, rest)| other_orders(&setup, &orders, &orders_at(&setup, rest?), when)),
        );
        let mut scene = Self { stage, setup, orders, damping: damping(case)?, start, equilibrium, doubts };
        for (own, balls) in scene.setup.bearings.iter().zip(&scene.equilibrium.bearings) {
            let name = if own.label.is_empty() { String::new() } else { format!("bearing {}: ", own.label) };
            match scene.rating_life(own, balls) {
                Err(error) => scene.doubts.push(format!("{name}no rating life, ISO 281 does not hold: {error}")),
                Ok(life) => scene.doubts.extend(life.doubt().map(|doubt| name + &doubt)),
            }
        }
        scene.doubts.extend(scene.heavy_damping(&run.seats, end - start));
        Ok(scene)
    }

    /// That contact damping makes a run of so many seconds slow, for each bearing of which that is so.
    pub(crate) fn heavy_damping(&self, seats: &[case::Seat<'_>], duration: f64) -> Vec<String> {
        let bearings = seats.iter().zip(&self.setup.bearings).zip(&self.equilibrium.bearings);
        let told = bearings.filter_map(|((seat, own), balls)| {
            let law = own.bearing.law();
            let stiffness = [&law.inner, &law.outer].map(|contact| contact.stiffness.at(1.0)[0]);
            let ball = PressedBall::of(stiffness, law.mass, balls.iter().map(|ball| ball.load))?;
            ball.doubt(&seat.key("bearing.contact_damping"), own.contact_damping, duration)
        });
        told.collect()
    }

    /// The same with a bearing whose grooves are whole.
    pub(crate) fn without_damage(&self, bearing: usize) -> Self {
        let mut scene = self.clone();
        let own = &mut scene.setup.bearings[bearing];
        own.bearing = own.bearing.clone().without_defects();
        scene
    }

    /// Load rating of a bearing, and its life under the loads at rest and at the speed at the start.
    ///
    /// # Errors
    /// [`BearingError`]: what the standard does not hold for.
    pub(crate) fn rating_life(
        &self,
        own: &BearingInPlace,
        balls: &[SpatialBallLoad],
    ) -> Result<RatingLife, BearingError> {
        let loads: Vec<[f64; 2]> = balls.iter().map(|ball| ball.load).collect();
        own.bearing.rating_life(&loads, Self::largest_pressure(own, balls), own.cage.shaft().speed(self.start))
    }

    /// Largest pressure under the balls of a bearing, Pa.
    pub(crate) fn largest_pressure(own: &BearingInPlace, balls: &[SpatialBallLoad]) -> f64 {
        let pressures = balls.iter().flat_map(|ball| {
            [Race::Inner, Race::Outer].into_iter().enumerate().map(|(index, race)| {
                let hertz = own.bearing.hertz_at(race, ball.contact_angle[index].unwrap_or(0.0));
                hertz.map_or(0.0, |hertz| hertz.patch(ball.load[index]).peak_pressure)
            })
        });
        pressures.fold(0.0, f64::max)
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
        if kept == 0 && modes.count() > 0 {
            return Err(SystemError::NoModesKept { lowest_hz: modes.frequency_hz(0) }.into());
        }
        let residual = model.residual && kept < structure.dof();
        let kept = if residual { kept } else { return Ok(modes.lowest(kept)) };
        Ok(with_static_vectors(structure, modes, kept, &self.setup)?.0)
    }

    /// A model's system, and where it rests at an instant (s) in its own basis: from elsewhere a run begins with a blow.
    ///
    /// # Errors
    /// [`ComputeError::System`] for a model that does not fit, or where nothing rests.
    pub(crate) fn at_rest(&self, model: &RunModel, time: f64) -> Result<(SpatialSystem, State), ComputeError> {
        let (system, basis) = self.system(model)?;
        let state = self.rest_in(&system, &basis, time)?;
        Ok((system, state))
    }

    /// A model's system, and its basis.
    ///
    /// # Errors
    /// [`ComputeError::System`] for a model that does not fit.
    pub(crate) fn system(&self, model: &RunModel) -> Result<(SpatialSystem, StructureModes), ComputeError> {
        let (structure, basis) = (&self.stage.structure, self.basis(model)?);
        let system = SpatialSystem::new(structure, &basis, self.setup.clone(), ModeSelection::All, &self.damping)?;
        Ok((system, basis))
    }

    /// Where it rests at an instant (s).
    ///
    /// # Errors
    /// [`ComputeError::System`] where nothing rests.
    pub(crate) fn rest_in(
        &self,
        system: &SpatialSystem,
        basis: &StructureModes,
        time: f64,
    ) -> Result<State, ComputeError> {
        let condition = SpatialCondition::at(&self.setup, time);
        let rest = SpatialEquilibrium::in_modes(&self.stage.structure, basis, &self.setup, &condition)?;
        Ok(system.state_at(time, &rest, basis))
    }
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
            (preload, _) => offset(&bearing, preload).map_err(ComputeError::bearing(seat.key("bearing.preload: ")))?,
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
    let speed = |time: f64| shaft.motion(time).speed.abs();
    let fastest = shaft.fastest_instant(start, end);
    let mut orders: Vec<DefectOrders> = Vec::new();
    for _ in 0..ROUNDS {
        let condition = SpatialCondition::at(setup, fastest);
        let equilibrium = SpatialEquilibrium::find(&stage.structure, setup, &condition)
            .map_err(|error| nothing_rests(setup, speed(fastest), &condition, &error))?;
        accept(&run.seats, setup, &equilibrium, "at the highest speed")?;
        let before = std::mem::take(&mut orders);
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
        let alike = |(old, new): (&DefectOrders, &DefectOrders)| (new.cage / old.cage - 1.0).abs() <= SETTLED;
        if !before.is_empty() && before.iter().zip(&orders).all(alike) {
            break;
        }
    }
    Ok(orders)
}

/// Orders of each bearing at the contact angles of a rest; `None` where no ball is loaded.
fn orders_at(setup: &SpatialSetup, rest: &SpatialEquilibrium) -> Vec<Option<DefectOrders>> {
    let orders = |(own, balls): (&BearingInPlace, &Vec<SpatialBallLoad>)| {
        let geometry = own.bearing.geometry();
        let ratio = cage_ratio(&own.bearing, balls)?;
        Some(DefectOrders::of_cage(f64::from(geometry.balls()), geometry.diameter_ratio(), ratio))
    };
    setup.bearings.iter().zip(&rest.bearings).map(orders).collect()
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
