//! The coupled system of a scene as equations of first order, as other integrators take them.

use plummer::app::case::Case;
use plummer::app::commands::run::choice::ModelChoice;
use plummer::app::scene::{RunModel, Scene};
use plummer::numerics::Unwatched;
use plummer::numerics::ode::{SecondOrderSystem, State, Tangent};
use plummer::system::CoupledSystem;
use std::error::Error;

/// A scene's system with its state at rest.
///
/// `x = (y, v)` in units of `scale`, time from the scene's start on. Coordinates differ by orders of magnitude; in units of
/// what each of them reaches one tolerance is right for all, and integrators with a single one lose nothing.
pub struct Equations {
    system: CoupledSystem,
    chosen: RunModel,
    rest: State,
    scale: Vec<f64>,
    /// Evaluations of the right-hand side since they were taken last.
    evaluations: u64,
    state: Vec<f64>,
    force: Vec<f64>,
    tangent: Tangent,
    /// Where the tangent was found.
    tangent_at: (f64, Vec<f64>),
    linearisations: u64,
}

impl Equations {
    /// Of a case file with overrides (`key=value`), in the model that the case asks for.
    pub fn of_case(path: &str, set: &[String]) -> Result<Self, Box<dyn Error>> {
        let case = Case::load(path, set)?;
        let run = case.for_run()?;
        let scene = Scene::build(run, &Unwatched)?;
        let chosen = ModelChoice::of_case(run, &scene)?.model;
        let mut setup = scene.setup.clone();
        setup.balls_inertia = chosen.balls_inertia;
        let (structure, modes) = (&scene.stage.structure, &scene.stage.modes);
        let system = CoupledSystem::new(structure, modes, setup, chosen.modes, &scene.damping, chosen.residual)?;
        let rest = system.state_at(scene.start, &scene.equilibrium, modes);
        let dof = rest.y.len();
        Ok(Self {
            system,
            chosen,
            rest,
            scale: vec![1.0; 2 * dof],
            evaluations: 0,
            state: vec![0.0; 2 * dof],
            force: vec![0.0; dof],
            tangent: Tangent::new(dof),
            tangent_at: (f64::NAN, vec![0.0; 2 * dof]),
            linearisations: 0,
        })
    }

    /// Method and step that the program chooses or the case gives.
    pub fn chosen(&self) -> RunModel {
        self.chosen
    }

    /// The system, to be stepped by the program's own methods.
    pub fn system_mut(&mut self) -> &mut CoupledSystem {
        &mut self.system
    }

    /// At rest where the scene starts.
    pub fn rest(&self) -> &State {
        &self.rest
    }

    /// Number of coordinates and velocities.
    pub fn size(&self) -> usize {
        self.scale.len()
    }

    /// What coordinates and velocities are measured in from here on, each positive.
    pub fn set_scale(&mut self, scale: &[f64]) {
        self.scale.copy_from_slice(scale);
        self.tangent_at.0 = f64::NAN;
    }

    /// The state at rest in these units.
    pub fn start(&self) -> Vec<f64> {
        let mut x = vec![0.0; self.size()];
        self.measure(&self.rest.y, &self.rest.v, &mut x);
        x
    }

    /// A state in these units.
    pub fn measure(&self, y: &[f64], v: &[f64], x: &mut [f64]) {
        for ((x, value), scale) in x.iter_mut().zip(y.iter().chain(v)).zip(&self.scale) {
            *x = value / scale;
        }
    }

    /// A state out of these units.
    pub fn state(&self, t: f64, x: &[f64]) -> State {
        let dof = self.size() / 2;
        let mut values: Vec<f64> = x.iter().zip(&self.scale).map(|(x, s)| x * s).collect();
        let v = values.split_off(dof);
        State { t: self.rest.t + t, y: values, v }
    }

    fn take(&mut self, x: &[f64]) {
        for ((state, x), scale) in self.state.iter_mut().zip(x).zip(&self.scale) {
            *state = x * scale;
        }
    }

    /// `dx = f(t, x)`.
    pub fn rhs_into(&mut self, t: f64, x: &[f64], dx: &mut [f64]) {
        self.evaluations += 1;
        self.take(x);
        let (y, v) = self.state.split_at(self.force.len());
        self.system.force_into(self.rest.t + t, y, v, &mut self.force);
        let (of_y, of_v) = dx.split_at_mut(self.force.len());
        let (scale_y, scale_v) = self.scale.split_at(self.force.len());
        for (i, linear) in self.system.linear().iter().enumerate() {
            let pull = linear.damping * v[i] + linear.squared_frequency * y[i];
            of_y[i] = v[i] / scale_y[i];
            of_v[i] = (self.force[i] - pull) / scale_v[i];
        }
    }

    /// `out = (df/dx) w`; the contacts' tangent is found once for all products at a state.
    pub fn jacobian_times(&mut self, t: f64, x: &[f64], w: &[f64], out: &mut [f64]) {
        if t.to_bits() != self.tangent_at.0.to_bits() || x != self.tangent_at.1 {
            self.take(x);
            self.tangent.clear();
            let (y, v) = self.state.split_at(self.force.len());
            self.system.tangent_into(self.rest.t + t, y, v, &mut self.tangent);
            self.linearisations += 1;
            self.tangent_at.0 = t;
            self.tangent_at.1.copy_from_slice(x);
        }
        self.take(w);
        let (dy, dv) = self.state.split_at(self.force.len());
        self.force.fill(0.0);
        self.tangent.apply(dy, dv, &mut self.force);
        let (of_y, of_v) = out.split_at_mut(self.force.len());
        let (scale_y, scale_v) = self.scale.split_at(self.force.len());
        for (i, linear) in self.system.linear().iter().enumerate() {
            let pull = linear.damping * dv[i] + linear.squared_frequency * dy[i];
            of_y[i] = dv[i] / scale_y[i];
            of_v[i] = (self.force[i] - pull) / scale_v[i];
        }
    }

    /// Evaluations of the right-hand side, and of the contacts' tangent with it, since the last call.
    pub fn take_evaluations(&mut self) -> u64 {
        std::mem::take(&mut self.evaluations) + std::mem::take(&mut self.linearisations)
    }
}
