//! How the force changes with the state: a sum of few products, one a contact and direction, instead of a full matrix.
//!
//! ```text
//! d g = sum_k left_k (position_k . d y + velocity_k . d v)
//! ```

/// A sum of products of rank one; all rows have one entry a coordinate.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Tangent {
    /// Number of coordinates.
    pub(crate) dof: usize,
    /// Number of terms.
    pub(crate) terms: usize,
    /// [terms x 3 x dof]: left, position, velocity.
    values: Vec<f64>,
}

/// One product `left (position . d y + velocity . d v)`, each \[dof\].
#[derive(Debug, PartialEq)]
pub struct TangentTerm<'a> {
    /// Direction in which the force changes.
    pub left: &'a mut [f64],
    /// By which displacements, 1/s^2 with `left` without unit.
    pub position: &'a mut [f64],
    /// By which velocities, 1/s.
    pub velocity: &'a mut [f64],
}

impl Tangent {
    /// No terms, for so many coordinates.
    #[must_use]
    pub fn new(dof: usize) -> Self {
        Self { dof, terms: 0, values: Vec::new() }
    }

    /// Takes all terms out; the memory stays.
    pub(crate) fn clear(&mut self) {
        self.terms = 0;
    }

    /// Adds a term of zeros, to be filled.
    pub(crate) fn add(&mut self) -> TangentTerm<'_> {
        let size = 3 * self.dof;
        let start = self.terms * size;
        self.terms += 1;
        self.values.resize(self.values.len().max(start + size), 0.0);
        let values = &mut self.values[start..start + size];
        values.fill(0.0);
        let (left, rest) = values.split_at_mut(self.dof);
        let (position, velocity) = rest.split_at_mut(self.dof);
        TangentTerm { left, position, velocity }
    }

    /// Row `left` of a term.
    #[must_use]
    pub(crate) fn left(&self, term: usize) -> &[f64] {
        self.row(3 * term)
    }

    /// Row `position` of a term.
    #[must_use]
    pub(crate) fn position(&self, term: usize) -> &[f64] {
        self.row(3 * term + 1)
    }

    /// Row `velocity` of a term.
    #[must_use]
    pub(crate) fn velocity(&self, term: usize) -> &[f64] {
        self.row(3 * term + 2)
    }

    fn row(&self, row: usize) -> &[f64] {
        &self.values[row * self.dof..(row + 1) * self.dof]
    }

    /// Adds the change of force for a change of the state to `dg`, all \[dof\].
    pub(crate) fn apply(&self, dy: &[f64], dv: &[f64], dg: &mut [f64]) {
        for term in 0..self.terms {
            let factor = dot(self.position(term), dy) + dot(self.velocity(term), dv);
            for (dg, left) in dg.iter_mut().zip(self.left(term)) {
                *dg += factor * left;
            }
        }
    }
}

/// Sum of products, from the first on.
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn terms_are_blank_when_memory_is_used_again() {
        let mut tangent = Tangent::new(2);
        for factor in [3.0, 5.0] {
            tangent.clear();
            let term = tangent.add();
            term.left[0] = factor;
            term.position[1] = 2.0;
            let mut dg = [1.0, 1.0];
            tangent.apply(&[7.0, 0.5], &[9.0, 9.0], &mut dg);
            assert!((dg[0] - 1.0 - factor).abs() < 1e-15 && (dg[1] - 1.0).abs() < 1e-15);
            tangent.add().velocity[0] = 4.0;
            assert_eq!(tangent.terms, 2);
        }
        tangent.clear();
        tangent.add();
        assert_eq!(tangent.velocity(0), [0.0, 0.0]);
    }
}
