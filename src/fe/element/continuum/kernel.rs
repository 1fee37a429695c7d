//! The sum over the points and the contraction with the elasticity.
//!
//! `K_ab = int B_a^T D B_b dV` needs only `H_ab[i][j] = int dN_a/dx_i dN_b/dx_j dV` of the geometry:
//! `K_ab[i][k] = C_ijkl H_ab[j][l]`. H is summed over the points without looking at the material, and
//! contracted once a pair of nodes.

use super::geometry::Jacobian;
use super::properties::{Elasticity, Tensor};
use super::table::Table;

/// Points whose gradients are kept together: with their weighted copies 7.7 kB of the first cache for Hex20.
const BLOCK: usize = 8;

/// The pairs of directions that are stored: H of (j, i) is the transposed one of (i, j).
const PAIRS: [[usize; 2]; 6] = [[0, 0], [0, 1], [1, 1], [0, 2], [1, 2], [2, 2]];
/// Where a pair with i <= j is stored.
const PAIR_AT: [[usize; 3]; 3] = [[0, 1, 3], [1, 2, 4], [3, 4, 5]];

/// `H_ab[i][j]`, m, over the M functions of an element, as `[pair of i and j][b][a]`; `m^0` in the plane.
#[derive(Debug)]
pub(super) struct Couplings<const M: usize>([[[f64; M]; M]; 6]);

impl<const M: usize> Couplings<M> {
    pub(super) fn zeros() -> Self {
        Self([[[0.0; M]; M]; 6])
    }

    /// Adds all points of a table; the N functions of the nodes come first, with a centre the D bubbles
    /// `1 - xi_d^2` follow (M = N + D). Of the centre it takes the inverse Jacobian times its determinant, which incompatible
    /// modes use instead of their own. Returns the smallest determinant.
    pub(super) fn integrate<const N: usize, const D: usize>(
        &mut self,
        coords: &[[f64; 3]; N],
        table: &Table,
        centre: Option<[[f64; 3]; 3]>,
    ) -> f64 {
        let mut smallest = f64::INFINITY;
        let rows = table.derivatives::<N>();
        for (points, rows) in table.points.chunks(BLOCK).zip(rows.chunks(BLOCK * D)) {
            let mut gradients = [[[0.0; M]; D]; BLOCK];
            let mut weighted = [[[0.0; M]; D]; BLOCK];
            let block = gradients.iter_mut().zip(&mut weighted);
            let given = points.iter().zip(rows.chunks_exact(D));
            for ((point, rows), (gradient, weighted)) in given.zip(block) {
                let (determinant, inverse) = Jacobian::new::<N, D>(coords, rows).inverse();
                smallest = smallest.min(determinant);
                let volume = point.weight * determinant;
                for i in 0..D {
                    for a in 0..N {
                        let mut sum = 0.0;
                        for d in 0..D {
                            sum += inverse[d][i] * rows[d][a];
                        }
                        gradient[i][a] = sum;
                    }
                    if let Some(centre) = centre {
                        for d in 0..M - N {
                            let slope = -2.0 * point.natural[d] / determinant;
                            gradient[i][N + d] = centre[d][i] * slope;
                        }
                    }
                    for a in 0..M {
                        weighted[i][a] = volume * gradient[i][a];
                    }
                }
            }
            self.add::<D>(&gradients[..points.len()], &weighted[..points.len()]);
        }
        smallest
    }

    /// `H += sum of gradient times weighted gradient`, row after row: a row stays in registers over the block.
    #[inline(always)]
    fn add<const D: usize>(&mut self, gradients: &[[[f64; M]; D]], weighted: &[[[f64; M]; D]]) {
        for (pair, [i, j]) in PAIRS[..D * (D + 1) / 2].iter().enumerate() {
            for b in 0..M {
                let mut row = self.0[pair][b];
                for (left, right) in gradients.iter().zip(weighted) {
                    let factor = right[*j][b];
                    for a in 0..M {
                        row[a] += left[*i][a] * factor;
                    }
                }
                self.0[pair][b] = row;
            }
        }
    }

    /// `t K` into a matrix of M D rows, column by column, both triangles.
    pub(super) fn contract<const D: usize>(&self, elasticity: &Elasticity, thickness: f64, out: &mut [f64]) {
        match elasticity {
            Elasticity::Isotropic { lambda, mu } => {
                let (lambda, mu) = (lambda * thickness, mu * thickness);
                self.fill::<D>(out, |h| isotropic::<D>(lambda, mu, h));
            }
            Elasticity::General(tensor) => {
                self.fill::<D>(out, |h| general::<D>(tensor, thickness, h));
            }
        }
    }

    #[inline(always)]
    fn fill<const D: usize>(&self, out: &mut [f64], block: impl Fn([[f64; D]; D]) -> [[f64; D]; D]) {
        let rows = M * D;
        for b in 0..M {
            let columns = &mut out[b * D * rows..][..D * rows];
            for a in 0..=b {
                let k = block(self.between::<D>(a, b));
                for j in 0..D {
                    let entries = &mut columns[j * rows + a * D..][..D];
                    for i in 0..D {
                        entries[i] = k[i][j];
                    }
                }
            }
        }
        mirror(out, rows);
    }

    /// `H_ab[i][j]` for a <= b.
    #[inline(always)]
    fn between<const D: usize>(&self, a: usize, b: usize) -> [[f64; D]; D] {
        let mut h = [[0.0; D]; D];
        for i in 0..D {
            for j in 0..D {
                let stored = &self.0[PAIR_AT[i][j]];
                h[i][j] = if i <= j { stored[b][a] } else { stored[a][b] };
            }
        }
        h
    }
}

/// The lower triangle from the upper one.
#[inline(always)]
pub(super) fn mirror(out: &mut [f64], rows: usize) {
    for column in 1..rows {
        for row in 0..column {
            out[row * rows + column] = out[column * rows + row];
        }
    }
}

/// `lambda H_ij + mu H_ji + mu tr(H) delta_ij`.
#[inline(always)]
fn isotropic<const D: usize>(lambda: f64, mu: f64, h: [[f64; D]; D]) -> [[f64; D]; D] {
    let trace: f64 = (0..D).map(|i| h[i][i]).sum();
    let mut k = [[0.0; D]; D];
    for i in 0..D {
        for j in 0..D {
            k[i][j] = lambda * h[i][j] + mu * h[j][i];
        }
        k[i][i] += mu * trace;
    }
    k
}

/// `t C_ijkl H_jl`.
#[inline(always)]
fn general<const D: usize>(c: &Tensor, thickness: f64, h: [[f64; D]; D]) -> [[f64; D]; D] {
    let mut k = [[0.0; D]; D];
    for i in 0..D {
        for m in 0..D {
            let mut sum = 0.0;
            for j in 0..D {
                for l in 0..D {
                    sum += c[i][j][m][l] * h[j][l];
                }
            }
            k[i][m] = thickness * sum;
        }
    }
    k
}
