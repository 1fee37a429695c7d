//! Rigid modes, recognised by their energy.

/// Ratio of strain energies below which a mode counts as rigid beside the next one: frequencies
/// 1e-5 apart. Round-off leaves 1e-14 and less, the softest support in use 1e-6 and more.
const ENERGY_RATIO: f64 = 1e-10;

/// Number of rigid modes among ascending eigenvalues (1/s^2): those whose strain energy at unit
/// kinetic energy vanishes beside that of the first mode after them. Three in the plane, six in space, more for
/// parts that are not connected and for mechanisms.
pub fn rigid_mode_count(eigenvalues: &[f64]) -> usize {
    let rigid = |count: &usize| {
        let below = eigenvalues[..*count]
            .iter()
            .fold(0.0_f64, |largest, value| largest.max(value.abs()));
        eigenvalues
            .get(*count)
            .is_some_and(|&next| below < ENERGY_RATIO * next)
    };
    (1..=eigenvalues.len()).rfind(rigid).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::rigid_mode_count;

    #[test]
    fn counts_what_has_no_energy() {
        assert_eq!(rigid_mode_count(&[1e-7, -3e-6, 2e-5, 1e11, 1e11]), 3);
        assert_eq!(rigid_mode_count(&[1e-7, 3e9, 1e11]), 1);
        assert_eq!(rigid_mode_count(&[5e8, 1e9, 1e11]), 0);
        assert_eq!(rigid_mode_count(&[]), 0);
        let two_bodies: Vec<f64> = (0..12).map(|k| 1e-6 * f64::from(k)).chain([1e9]).collect();
        assert_eq!(rigid_mode_count(&two_bodies), 12);
    }
}
