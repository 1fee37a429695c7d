//! The other places where a shaft may rest: clearance leaves several.

use super::equilibrium::{Contacts, Problem, SpatialCondition, SpatialEquilibrium};
use super::setup::{SHAFT, SpatialSetup};
use crate::system::equilibrium::{Found, Search};
use crate::system::{Structure, SystemError};

/// Distance of two places of the shaft, tilts times the pitch radius, below which two equilibria are one, m: a thousandth of the
/// clearances that part them.
const SAME: f64 = 1e-9;

impl SpatialEquilibrium {
    /// The equilibrium of [`find`](Self::find) first, then the other stable ones to which those of the same shaft in rigid outer rings
    /// lead, then the saddles between neighbours. Places along a direction that nothing holds count as one.
    ///
    /// # Errors
    /// As [`find`](Self::find); a start that leads nowhere is no error.
    pub(crate) fn find_all(
        structure: &Structure,
        setup: &SpatialSetup,
        condition: &SpatialCondition,
    ) -> Result<Vec<Self>, SystemError> {
        let response = |loads: &_| structure.static_response(loads);
        let (mut problem, loads, flexibility) = Problem::new(structure, setup, condition, 0.0, response)?;
        let rest = problem.rest_in_rigid_rings();
        let rigid = problem.in_rigid_rings().and_then(|(shaft, load)| shaft.find_all(&load)).unwrap_or_default();
        let mut found = vec![problem.settled(problem.start(&rest, &flexibility))?];
        for other in rigid.iter().filter(|other| other.is_stable() && other.displacement != rest) {
            let start = problem.start(&other.displacement, &flexibility);
            keep(&mut found, problem.settled(start));
        }
        let [x, y, ..] = problem.load_at_rest();
        let mut stable: Vec<_> = found.iter().map(|found| found.z.clone()).collect();
        stable.sort_by(|a, b| (a[1] * x - a[0] * y).total_cmp(&(b[1] * x - b[0] * y)));
        for pair in stable.windows(2) {
            let between = (&pair[0] + &pair[1]) * 0.5;
            problem.friction = problem.friction_at(&between);
            keep(&mut found, problem.search(between, false));
        }
        let all = found.iter().map(|found| problem.result(found, &loads)).enumerate();
        let held = all.filter(|(number, rest)| *number == 0 || rest.pushed_apart(setup).is_none());
        Ok(held.map(|(_, rest)| rest).collect())
    }
}

/// Adds what is not there yet.
fn keep(all: &mut Vec<Found<Contacts>>, new: Result<Found<Contacts>, SystemError>) {
    let Ok(new) = new else { return };
    let apart = |old: &Found<Contacts>| (old.z.rows(0, SHAFT) - new.z.rows(0, SHAFT)).amax() > SAME;
    if all.iter().all(apart) {
        all.push(new);
    }
}
