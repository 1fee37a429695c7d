//! Springs between a ring and the ground.

use super::{NODE_DOF, Ring, RingError, RingSpring};
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

/// How a support's stiffness is meant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SpringShare {
    /// Each node carries the given stiffness.
    PerNode,
    /// The nodes share the given stiffness equally.
    Total,
}

impl Ring {
    /// The node of a degree of freedom, and whether it is one of the ring's plane.
    pub(in crate::model) fn node_of(&self, dof: usize) -> (usize, bool) {
        let place = dof / NODE_DOF;
        (place % self.nodes, place < self.nodes)
    }

    /// Attaches springs to the ground; at a node at angle phi the spring acts on the point
    /// `offset` outside, which moves by the node's displacement plus `offset theta e_phi` in the plane and
    /// `offset omega x e_r` in space.
    ///
    /// # Errors
    /// [`RingError::EmptySupport`].
    pub fn add_support(&mut self, support: &RingSupport) -> Result<(), RingError> {
        let span = support.to - support.from;
        // an angle counts as `from` itself, and as outside at `to`, within round-off of a turn
        let round_off = 1e-9;
        let inside = |angle: f64| {
            let past = (angle - support.from + round_off).rem_euclid(TAU) - round_off;
            past < span - round_off
        };
        let angles: Vec<(usize, f64)> = (0..self.nodes)
            .map(|node| (node, self.node_angle(node)))
            .filter(|&(_, angle)| inside(angle))
            .collect();
        if angles.is_empty() {
            return Err(RingError::EmptySupport {
                from_deg: support.from.to_degrees(),
                to_deg: support.to.to_degrees(),
                nodes: self.nodes,
                spacing_deg: 360.0 / self.nodes as f64,
            });
        }
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
                if stiffness > 0.0 {
                    self.springs.push(RingSpring {
                        dofs: [*first, first + 1, first + 2],
                        row: *row,
                        stiffness: share * stiffness,
                    });
                }
                for i in 0..NODE_DOF {
                    for j in 0..NODE_DOF {
                        self.stiffness[(*first + i, *first + j)] +=
                            share * stiffness * row[i] * row[j];
                    }
                }
            }
        }
        Ok(())
    }
}
