//! What the solid and plane elements are made of.
//!
//! Orthotropic materials: nine constants and the axes they hold in.

use super::{Material, MaterialError, check};
use nalgebra::Vector3;
use std::array::from_fn;

/// A linear elastic material, isotropic or orthotropic.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ElasticMaterial {
    /// The same in every direction.
    Isotropic(Material),
    /// Three planes of symmetry; carries its own axes.
    Orthotropic(OrthotropicMaterial),
}

impl From<Material> for ElasticMaterial {
    fn from(material: Material) -> Self {
        Self::Isotropic(material)
    }
}

impl From<OrthotropicMaterial> for ElasticMaterial {
    fn from(material: OrthotropicMaterial) -> Self {
        Self::Orthotropic(material)
    }
}

impl ElasticMaterial {
    /// Density rho, kg/m^3.
    pub(crate) fn density(&self) -> f64 {
        match self {
            Self::Isotropic(material) => material.density,
            Self::Orthotropic(material) => material.density,
        }
    }

    /// Structural loss factor eta, in [0, 2).
    pub(crate) fn loss_factor(&self) -> f64 {
        match self {
            Self::Isotropic(material) => material.loss_factor,
            Self::Orthotropic(material) => material.loss_factor,
        }
    }
}

/// A linear elastic material with three perpendicular planes of symmetry.
///
/// Built by [`OrthotropicMaterial::new`] alone, so its compliance is positive definite and its axes are
/// orthonormal. Indices 0, 1, 2 and the letters x, y, z mean the material axes, not those of the mesh.
///
/// `nu_ij = -eps_j / eps_i` under a stress along i alone: the first index is the direction of the stress.
/// The other three follow from `nu_ji / E_j = nu_ij / E_i`.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct OrthotropicMaterial {
    /// Young's moduli along x, y, z, Pa, > 0.
    pub young: [f64; 3],
    /// Poisson's ratios xy, yz, xz.
    pub poisson: [f64; 3],
    /// Shear moduli xy, yz, xz, Pa, > 0.
    pub shear: [f64; 3],
    /// Density rho, kg/m^3, > 0.
    pub density: f64,
    /// Structural loss factor eta of the whole stiffness, in [0, 2).
    pub loss_factor: f64,
    /// Material axes x, y, z as unit vectors in mesh coordinates, right-handed.
    pub axes: [[f64; 3]; 3],
}

/// Smallest sine of the angle between the two vectors that give the axes (a few thousandths of a degree):
/// below it the rounding of a direction typed with four digits decides where y points.
const SMALLEST_SINE: f64 = 1e-4;

/// The two directions of each of the Voigt components xx, yy, zz, xy, yz, xz.
const VOIGT: [[usize; 2]; 6] = [[0, 0], [1, 1], [2, 2], [0, 1], [1, 2], [0, 2]];

impl OrthotropicMaterial {
    /// A material from its constants (see the fields) and two vectors in mesh coordinates: `axis_x` along
    /// the material's x, and `towards_y` in the half plane of x and y. Neither needs unit length; z
    /// is `x` cross `towards_y`, y is z cross x.
    ///
    /// The compliance is positive definite if all moduli are positive, each `nu_ij^2 < E_i / E_j`, and
    /// `1 - nu_xy^2 E_y/E_x - nu_yz^2 E_z/E_y - nu_xz^2 E_z/E_x - 2 nu_xy nu_yz nu_xz E_z/E_x > 0`
    /// (Lempriere, AIAA Journal 6 (1968) 2226).
    ///
    /// # Errors
    /// [`MaterialError::Refused`] for a modulus, a ratio or a density out of its range or not finite,
    /// [`MaterialError::Refused`] for three ratios that do not go together,
    /// [`MaterialError::Refused`] and [`MaterialError::ParallelAxes`] for vectors that give no axes.
    pub fn new(
        young: [f64; 3],
        poisson: [f64; 3],
        shear: [f64; 3],
        density: f64,
        axis_x: [f64; 3],
        towards_y: [f64; 3],
    ) -> Result<Self, MaterialError> {
        let positive = "positive and finite";
        let names = ["E_x (Pa)", "E_y (Pa)", "E_z (Pa)", "G_xy (Pa)", "G_yz (Pa)", "G_xz (Pa)"];
        for (&value, name) in young.iter().chain(&shear).zip(names) {
            check(value > 0.0, name, positive, value)?;
        }
        check_ratios(young, poisson)?;
        check(density > 0.0, "density (kg/m^3)", positive, density)?;
        Ok(Self { young, poisson, shear, density, loss_factor: 0.0, axes: orthonormal(axis_x, towards_y)? })
    }

    /// The same material with a structural loss factor, 0 <= eta < 2.
    ///
    /// # Errors
    /// [`MaterialError::Refused`].
    pub(crate) fn with_loss_factor(self, loss_factor: f64) -> Result<Self, MaterialError> {
        check((0.0..2.0).contains(&loss_factor), "loss factor", "from 0 to below 2", loss_factor)?;
        Ok(Self { loss_factor, ..self })
    }

    /// Stiffness C (6 x 6, Pa) in mesh axes: `sigma = C eps` with both in the order xx, yy, zz, xy, yz,
    /// xz and engineering shear strains (`gamma_xy = du_x/dy + du_y/dx`). Symmetric and positive definite.
    ///
    /// The inverse of the compliance
    /// `S_ii = 1 / E_i`, `S_ij = -nu_ij / E_i`, shear `1 / G_ij`, as `C = T^T S^-1 T`, where T (6 x 6) takes
    /// strains from mesh to material axes.
    pub(crate) fn stiffness_matrix(&self) -> [[f64; 6]; 6] {
        let own = self.stiffness_in_own_axes();
        let t = strain_rotation(self.axes);
        let half: [[f64; 6]; 6] = from_fn(|i| from_fn(|j| (0..6).map(|k| own[i][k] * t[k][j]).sum()));
        let mut c = [[0.0; 6]; 6];
        for i in 0..6 {
            for j in i..6 {
                c[i][j] = (0..6).map(|k| t[k][i] * half[k][j]).sum();
                c[j][i] = c[i][j];
            }
        }
        c
    }

    /// The normal block by cofactors of the normalised compliance `[[1, -a, -c], [-a, 1, -b], [-c, -b, 1]]`,
    /// `S_ij = s_ij / sqrt(E_i E_j)`.
    fn stiffness_in_own_axes(&self) -> [[f64; 6]; 6] {
        let [a, b, c] = normalised_ratios(self.young, self.poisson);
        let cofactors = [
            [1.0 - b * b, a + b * c, c + a * b],
            [a + b * c, 1.0 - c * c, b + a * c],
            [c + a * b, b + a * c, 1.0 - a * a],
        ];
        let determinant = determinant([a, b, c]);
        let mut stiffness = [[0.0; 6]; 6];
        for (i, row) in cofactors.iter().enumerate() {
            for (j, cofactor) in row.iter().enumerate() {
                let root = self.young[i].sqrt() * self.young[j].sqrt();
                stiffness[i][j] = root * cofactor / determinant;
            }
            stiffness[i + 3][i + 3] = self.shear[i];
        }
        stiffness
    }
}

/// `nu_ij sqrt(E_j / E_i)` for xy, yz, xz: symmetric in i and j, and of magnitude below 1.
fn normalised_ratios(young: [f64; 3], poisson: [f64; 3]) -> [f64; 3] {
    let [x, y, z] = young;
    [poisson[0] * (y / x).sqrt(), poisson[1] * (z / y).sqrt(), poisson[2] * (z / x).sqrt()]
}

/// Determinant of the normalised compliance.
fn determinant([a, b, c]: [f64; 3]) -> f64 {
    1.0 - a * a - b * b - c * c - 2.0 * a * b * c
}

fn check_ratios(young: [f64; 3], poisson: [f64; 3]) -> Result<(), MaterialError> {
    let names = ["nu_xy", "nu_yz", "nu_xz"];
    let rules = [
        "smaller than sqrt(E_x / E_y) in magnitude",
        "smaller than sqrt(E_y / E_z) in magnitude",
        "smaller than sqrt(E_x / E_z) in magnitude",
    ];
    let normalised = normalised_ratios(young, poisson);
    for i in 0..3 {
        check(normalised[i].abs() < 1.0, names[i], rules[i], poisson[i])?;
    }
    let determinant = determinant(normalised);
    if determinant > 0.0 {
        return Ok(());
    }
    Err(MaterialError::Refused(format!(
        "the three Poisson's ratios do not go together: 1 - nu_xy^2 E_y/E_x - nu_yz^2 E_z/E_y - nu_xz^2 E_z/E_x - 2 nu_xy nu_yz nu_xz E_z/E_x must be positive, found {determinant}"
    )))
}

/// Right-handed orthonormal axes, x first (Gram-Schmidt).
fn orthonormal(axis_x: [f64; 3], towards_y: [f64; 3]) -> Result<[[f64; 3]; 3], MaterialError> {
    let (x, y) = (unit(axis_x, "x")?, unit(towards_y, "y")?);
    let across = x.cross(&y);
    let sine = across.norm();
    if sine < SMALLEST_SINE {
        let ([a, b, c], [d, e, f]) = (axis_x, towards_y);
        return Err(MaterialError::ParallelAxes(format!(
            "the material axes x ({a}, {b}, {c}) and y ({d}, {e}, {f}) are parallel: two different directions are needed"
        )));
    }
    let z = across / sine;
    Ok([x, z.cross(&x), z].map(Into::into))
}

fn unit([x, y, z]: [f64; 3], axis: &'static str) -> Result<Vector3<f64>, MaterialError> {
    let largest = [x, y, z].into_iter().fold(0.0_f64, |largest, value| largest.max(value.abs()));
    let scaled = Vector3::new(x, y, z) / largest;
    let size = scaled.norm();
    if size > 0.0 && size.is_finite() && largest.is_finite() {
        return Ok(scaled / size);
    }
    Err(MaterialError::Refused(format!("the material axis {axis} needs a direction, found ({x}, {y}, {z})")))
}

/// T (6 x 6): strains in the axes from strains in the mesh, engineering shear on both sides. Source: Auld,
/// Acoustic Fields and Waves in Solids I (1973), the Bond strain matrix.
fn strain_rotation(axes: [[f64; 3]; 3]) -> [[f64; 6]; 6] {
    VOIGT.map(|[m, n]| {
        let engineering = if m == n { 1.0 } else { 2.0 };
        VOIGT.map(|[i, j]| engineering * 0.5 * (axes[m][i] * axes[n][j] + axes[m][j] * axes[n][i]))
    })
}

#[cfg(test)]
#[path = "orthotropic_tests.rs"]
mod tests;
