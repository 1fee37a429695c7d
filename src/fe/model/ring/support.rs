//! Springs between a ring and the ground.

use super::{NODE_DOF, Ring, RingError, RingSpring};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// Springs between part of a ring and the ground.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RingSupport {
    /// First angle, rad, included.
    pub from: f64,
    /// Last angle, rad, excluded.
    pub to: f64,
    /// Stiffness along the ring's x, y and, in space, its axis, N/m, >= 0; a ring in its plane has no use for the
    /// third.
    pub spring: [f64; 3],
    /// Whether every node gets the spring or all nodes share it.
    pub share: SpringShare,
    /// Distance of the attachment outside the node radius, m.
    pub offset: f64,
}

/// Whether a stiffness stands at each node or is shared by all.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SpringShare {
    /// Each node has a spring of this stiffness.
    #[default]
    #[serde(rename = "node")]
    PerNode,
    /// The springs sum up to this stiffness, all alike.
    Total,
}

/// Springs between part of a ring in its plane and the ground that act along the radius, and others across it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RadialSupport {
    /// First angle, rad, included.
    pub from: f64,
    /// Last angle, rad, excluded.
    pub to: f64,
    /// Stiffness of every node's spring along the radius, N/m, >= 0.
    pub radial: f64,
    /// The same along the ring, N/m, >= 0: without it such springs leave the ring free to turn.
    pub tangential: f64,
}

impl Ring {
    /// Attaches springs to the ground; at a node at angle phi the spring acts on the point
    /// `offset` outside, which moves by the node's displacement plus `offset theta e_phi` in the plane and
    /// `offset omega x e_r` in space.
    ///
    /// # Errors
    /// [`RingError`] for a support that no node stands on.
    pub fn add_support(&mut self, support: &RingSupport) -> Result<(), RingError> {
        let angles = self.nodes_between(support.from, support.to)?;
        let share = match support.share {
            SpringShare::PerNode => 1.0,
            SpringShare::Total => 1.0 / angles.len() as f64,
        };
        for (node, angle) in angles {
            let (sin, cos) = angle.sin_cos();
            let arm = support.offset;
            // displacement of the attachment in x and y from (u_x, u_y, theta_z), along the axis from
            // (u_z, theta_x, theta_y)
            let rows = [
                (NODE_DOF * node, [1.0, 0.0, -arm * sin]),
                (NODE_DOF * node, [0.0, 1.0, arm * cos]),
                (NODE_DOF * (self.nodes + node), [1.0, arm * sin, -arm * cos]),
            ];
            let directions = if self.is_in_space() { 3 } else { 2 };
            let acting = rows.iter().zip(support.spring).take(directions);
            for ((first, row), stiffness) in acting {
                self.add_spring(*first, *row, share * stiffness);
            }
        }
        Ok(())
    }

    /// Attaches radial springs to the ground, in the ring's plane. Where along the radius they end does not matter: a section
    /// is rigid.
    ///
    /// # Errors
    /// [`RingError`] for a support that no node stands on.
    pub fn add_radial_support(&mut self, support: &RadialSupport) -> Result<(), RingError> {
        for (node, angle) in self.nodes_between(support.from, support.to)? {
            let (sin, cos) = angle.sin_cos();
            let first = NODE_DOF * node;
            for (row, stiffness) in [([cos, sin, 0.0], support.radial), ([-sin, cos, 0.0], support.tangential)] {
                self.add_spring(first, row, stiffness);
            }
        }
        Ok(())
    }

    /// Attaches one spring to the ground that stretches by `row` times the three displacements from `first` on.
    fn add_spring(&mut self, first: usize, row: [f64; NODE_DOF], stiffness: f64) {
        if stiffness > 0.0 {
            self.springs.push(RingSpring { dofs: [first, first + 1, first + 2], row, stiffness });
        }
        for i in 0..NODE_DOF {
            for j in 0..NODE_DOF {
                self.stiffness[(first + i, first + j)] += stiffness * row[i] * row[j];
            }
        }
    }

    /// Nodes from one angle (rad, included) to another (excluded), with their angles.
    fn nodes_between(&self, from: f64, to: f64) -> Result<Vec<(usize, f64)>, RingError> {
        let span = to - from;
        // an angle counts as `from` itself, and as outside at `to`, within round-off of a turn
        let round_off = 1e-9;
        let inside = |angle: f64| {
            let past = (angle - from + round_off).rem_euclid(TAU) - round_off;
            past < span - round_off
        };
        let angles: Vec<(usize, f64)> =
            (0..self.nodes).map(|node| (node, self.node_angle(node))).filter(|&(_, angle)| inside(angle)).collect();
        if angles.is_empty() {
            let (from, to, spacing) = (from.to_degrees(), to.to_degrees(), 360.0 / self.nodes as f64);
            return Err(RingError(format!(
                "no ring node stands between {from} and {to} degrees (half-open); the {} nodes are {spacing} degrees apart",
                self.nodes
            )));
        }
        Ok(angles)
    }
}
