//! One ring of a section: its area, its second moments and its torsion constant.

use super::super::{Material, MaterialError};
use std::f64::consts::{FRAC_PI_2, PI};

/// One ring of a section: its own area, second moment and radius.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RingLayer {
    /// What it is made of.
    pub material: Material,
    /// Cross-section area A, m^2, > 0.
    pub area: f64,
    /// Second moment I of the area about its own centroid, axis along the ring's axis, m^4, > 0.
    pub inertia: f64,
    /// Second moment I_a of the area about the radial axis, m^4, > 0: bending out of the ring's plane.
    /// `None`: that of the rectangle, `RingLayer::out_of_plane_inertia`.
    pub axial_inertia: Option<f64>,
    /// Torsion constant J, m^4, > 0. `None`: that of the rectangle, `RingLayer::torsion_constant`.
    pub torsion: Option<f64>,
    /// Radius of its centroid line, m, > 0.
    pub radius: f64,
    /// Shear coefficient kappa in (0, 1], for shear in the plane and out of it; 5/6 for a rectangle
    /// (Timoshenko's first value).
    pub shear_coefficient: f64,
}

impl RingLayer {
    /// Second moment I_a about the radial axis, m^4: as given, or that of the rectangle which has the
    /// layer's area A and second moment I, radially `h = sqrt(12 I / A)` and along the axis `b = A / h`:
    ///
    /// ```text
    /// I_a = h b^3 / 12
    /// ```
    pub(crate) fn out_of_plane_inertia(&self) -> f64 {
        self.axial_inertia.unwrap_or_else(|| {
            let [radial, axial] = self.rectangle();
            radial * axial.powi(3) / 12.0
        })
    }

    /// Torsion constant J, m^4: as given, or that of the same rectangle by its series.
    pub(crate) fn torsion_constant(&self) -> f64 {
        self.torsion.unwrap_or_else(|| rectangle_torsion(self.rectangle()))
    }

    /// Sides (radial h, axial b), m, of the rectangle with this area and second moment: `h = sqrt(12 I / A)`, `b = A / h`.
    pub(crate) fn rectangle(&self) -> [f64; 2] {
        let radial = (12.0 * self.inertia / self.area).sqrt();
        [radial, self.area / radial]
    }
}

/// Torsion constant J of a rectangle, m^4, sides in m, a the longer one:
///
/// ```text
/// J = a b^3 / 3 (1 - 192/pi^5 b/a sum over n = 1, 3, 5, ... of tanh(n pi a / (2 b)) / n^5)
/// ```
///
/// 0.1406 a^4 for a square, towards a b^3 / 3 for a thin strip. Source: Timoshenko and Goodier, Theory
/// of Elasticity, 3rd ed., section 109.
fn rectangle_torsion([first, second]: [f64; 2]) -> f64 {
    let (long, short) = (first.max(second), first.min(second));
    // sum of 1/n^5 over odd n: (1 - 2^-5) zeta(5), zeta(5) from Abramowitz and Stegun, table 23.3;
    // what tanh lacks to 1 falls by exp(-pi) and more a term: round-off after eight
    let zeta_5 = 1.036_927_755_143_37;
    let lack: f64 = (0..8)
        .map(|k| {
            let n = f64::from(2 * k + 1);
            2.0 / ((2.0 * n * FRAC_PI_2 * long / short).exp() + 1.0) / n.powi(5)
        })
        .sum();
    let sum = 31.0 / 32.0 * zeta_5 - lack;
    long * short.powi(3) / 3.0 * (1.0 - 192.0 / PI.powi(5) * short / long * sum)
}

pub(super) fn check(index: usize, layer: &RingLayer) -> Result<(), MaterialError> {
    let positive = [
        ("area", layer.area),
        ("inertia", layer.inertia),
        ("radius", layer.radius),
        ("shear_coefficient", layer.shear_coefficient),
    ];
    let given = [("axial_inertia", layer.axial_inertia), ("torsion", layer.torsion)];
    let given = given.into_iter().filter_map(|(quantity, value)| Some((quantity, value?)));
    let refused = |quantity: &str, rule: &str, value: f64| {
        let message = format!("ring section {index}: {quantity} must be {rule}, found {value}");
        Err(MaterialError::Refused(message))
    };
    for (quantity, value) in positive.into_iter().chain(given) {
        if !(value > 0.0 && value.is_finite()) {
            return refused(quantity, "positive and finite", value);
        }
    }
    if layer.shear_coefficient > 1.0 {
        return refused("shear_coefficient", "at most 1", layer.shear_coefficient);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_torsion_of_rectangles_is_the_published_one() {
        // Timoshenko and Goodier, section 109, table of k1: four digits
        for (ratio, factor) in [(1.0, 0.1406), (1.2, 0.166), (1.5, 0.196), (2.0, 0.229), (3.0, 0.263), (10.0, 0.312)] {
            let found = rectangle_torsion([ratio, 1.0]) / ratio;
            assert!((found - factor).abs() < 6e-4, "{ratio}: {found}");
            // sides change places: the same section
            assert!((rectangle_torsion([1.0, ratio]) / ratio - found).abs() < 1e-15);
        }
        // the square to seven digits; a plain sum of a thousand terms for another ratio
        assert!((rectangle_torsion([2.0, 2.0]) / 16.0 - 0.140_577_0).abs() < 5e-8);
        let plain: f64 =
            (0..1000).map(|k| f64::from(2 * k + 1)).map(|n| (n * FRAC_PI_2 * 1.3).tanh() / n.powi(5)).sum();
        let expected = 1.3 / 3.0 * (1.0 - 192.0 / PI.powi(5) / 1.3 * plain);
        assert!((rectangle_torsion([1.3, 1.0]) / expected - 1.0).abs() < 1e-12);
        // thin strip: 1/3, less 0.63 b / a
        let thin = rectangle_torsion([1e4, 1.0]) / 1e4;
        assert!((thin - (1.0 - 0.630e-4) / 3.0).abs() < 1e-8, "{thin}");
    }

    #[test]
    fn a_rectangle_is_found_again_from_area_and_second_moment() {
        let (radial, axial) = (3e-3, 4e-3);
        let layer = RingLayer {
            material: Material::new(70e9, 0.33, 2700.0).expect("valid"),
            area: radial * axial,
            inertia: axial * radial * radial * radial / 12.0,
            axial_inertia: None,
            torsion: None,
            radius: 7.5e-3,
            shear_coefficient: 5.0 / 6.0,
        };
        let exact = radial * axial * axial * axial / 12.0;
        assert!((layer.out_of_plane_inertia() / exact - 1.0).abs() < 1e-12);
        let exact = rectangle_torsion([radial, axial]);
        assert!((layer.torsion_constant() / exact - 1.0).abs() < 1e-12);
        let given = RingLayer { axial_inertia: Some(1e-12), torsion: Some(2e-12), ..layer };
        assert!((given.out_of_plane_inertia() - 1e-12).abs() < 1e-27);
        assert!((given.torsion_constant() - 2e-12).abs() < 1e-27);
    }
}
