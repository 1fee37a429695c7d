//! What small angles leave of sines and cosines, without cancellation.

/// Differences of trigonometric functions that cancel near zero, by their power series.
pub(super) struct Differences {
    /// phi - sin phi
    pub(super) sine: f64,
    /// 1 - cos phi
    pub(super) cosine: f64,
    /// (sin phi - phi cos phi) / 2, of third order
    pub(super) third: f64,
    /// phi sin phi / 2 - (1 - cos phi), of fourth order
    pub(super) fourth: f64,
    /// phi + phi cos phi / 2 - 3/2 sin phi, of fifth order
    pub(super) fifth: f64,
}

impl Differences {
    /// Sixteen terms reach round-off for |phi| <= pi / 2.
    pub(super) fn at(phi: f64) -> Self {
        let square = phi * phi;
        let mut sums = Self { sine: 0.0, cosine: 0.0, third: 0.0, fourth: 0.0, fifth: 0.0 };
        let mut power = phi; // phi^(2k-1) / (2k-1)! with the sign (-1)^(k-1)
        for k in 1..=16 {
            let order = f64::from(k);
            let even = power * phi / (2.0 * order);
            let odd = power * square / (2.0 * order * (2.0 * order + 1.0));
            sums.cosine += even;
            sums.fourth += (order - 1.0) * even;
            sums.sine += odd;
            sums.third += order * odd;
            sums.fifth -= (order - 1.0) * odd;
            power = -odd;
        }
        sums
    }
}

#[cfg(test)]
mod tests {
    use super::Differences;

    #[test]
    fn the_series_are_the_differences() {
        for phi in [-1.5_f64, -0.4, 0.9, 1.57] {
            let (sin, cos) = phi.sin_cos();
            let found = Differences::at(phi);
            for (series, direct) in [
                (found.sine, phi - sin),
                (found.cosine, 1.0 - cos),
                (found.third, 0.5 * (sin - phi * cos)),
                (found.fourth, 0.5 * phi * sin - (1.0 - cos)),
                (found.fifth, phi + 0.5 * phi * cos - 1.5 * sin),
            ] {
                // round-off of the direct form, whose terms are of size 1
                assert!((series - direct).abs() < 1e-15, "{phi}: {series} {direct}");
            }
        }
    }

    #[test]
    fn small_angles_keep_their_digits() {
        let phi = 1e-4;
        let found = Differences::at(phi);
        // leading terms; the next ones are smaller by phi^2
        for (series, leading) in [
            (found.sine, phi.powi(3) / 6.0),
            (found.cosine, phi.powi(2) / 2.0),
            (found.third, phi.powi(3) / 6.0),
            (found.fourth, -phi.powi(4) / 24.0),
            (found.fifth, phi.powi(5) / 120.0),
        ] {
            assert!((series / leading - 1.0).abs() < 1e-8, "{series} {leading}");
        }
    }
}
