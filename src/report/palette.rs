//! Colours of plots, charts and shapes, the same in the pictures and in the browser.

/// Red, green and blue, 0 to 255.
pub(super) type Rgb = [u8; 3];

/// Colours written as in CSS.
const fn colours<const N: usize>(hex: [u32; N]) -> [Rgb; N] {
    let mut colours = [[0; 3]; N];
    let mut k = 0;
    while k < N {
        let [_, r, g, b] = hex[k].to_be_bytes();
        colours[k] = [r, g, b];
        k += 1;
    }
    colours
}

/// Viridis at k / 15: perceptually uniform, readable in grey and by the colour-blind (S. van der Walt, N. Smith,
/// matplotlib 1.5, 2015, public domain).
pub(super) const VIRIDIS: [Rgb; 16] = colours([
    0x44_01_54, 0x48_1a_6c, 0x47_2f_7d, 0x41_44_87, 0x39_56_8c, 0x31_68_8e, 0x2a_78_8e, 0x23_88_8e, 0x1f_98_8b,
    0x22_a8_84, 0x35_b7_79, 0x54_c5_68, 0x7a_d1_51, 0xa5_db_36, 0xd2_e2_1b, 0xfd_e7_25,
]);

/// White to dark blue, by even steps of lightness.
const BLUES: [Rgb; 5] = [[255, 255, 255], [206, 221, 236], [142, 178, 212], [75, 125, 175], [20, 61, 110]];

/// Colours of curves, bars and markers as the style sheet has them on white; the next one begins again.
pub(super) const SERIES: [&str; 6] = ["#1f5a99", "#c8511b", "#2e7d4f", "#7b4ea3", "#8c6d1f", "#4d5761"];

/// How many colours curves, bars and markers have.
pub(super) const COLOURS: usize = SERIES.len();

/// Colours of groups: muted, of similar lightness, told apart in print.
const GROUPS: [Rgb; 10] = colours([
    0x8f_ae_cb, 0xe0_a0_6c, 0x9b_bf_8f, 0xc9_94_b5, 0xd6_c1_6b, 0x7f_bf_c0, 0xd9_8a_86, 0xa9_9f_d1, 0xb0_a0_8c,
    0xb4_bb_c2,
]);

/// Colour of thick lines.
pub(super) const LINE: Rgb = [0xc8, 0x3a, 0x1b];

/// Colour of a group.
pub(super) fn group(index: usize) -> Rgb {
    GROUPS[index % GROUPS.len()]
}

/// The colour at a part of a scale, 0 to 1, straight between its `N` supports, two at least; `at` is taken to 0..1.
fn between<const N: usize>(scale: [Rgb; N], at: f64) -> Rgb {
    let place = at.clamp(0.0, 1.0) * (N - 1) as f64;
    let low = (place.floor() as usize).min(N - 2);
    let part = place - low as f64;
    let (a, b) = (scale[low], scale[low + 1]);
    std::array::from_fn(|k| (f64::from(a[k]) * (1.0 - part) + f64::from(b[k]) * part).round() as u8)
}

/// Viridis between its supports; `at` is taken to 0..1.
pub(super) fn viridis(at: f64) -> Rgb {
    between(VIRIDIS, at)
}

/// White to dark blue; `at` is taken to 0..1.
pub(super) fn blues(at: f64) -> Rgb {
    between(BLUES, at)
}

/// A colour made darker: 1 leaves it, 0 makes it black.
pub(super) fn shaded(colour: Rgb, light: f64) -> Rgb {
    colour.map(|c| (f64::from(c) * light.clamp(0.0, 1.0)).round() as u8)
}

/// As CSS writes it.
pub(super) fn hex([r, g, b]: Rgb) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_map_gets_lighter_all_the_way() {
        // Relative luminance, ITU-R BT.709; the map is also right when printed in grey.
        let luminance = |[r, g, b]: Rgb| {
            let linear = |c: u8| (f64::from(c) / 255.0).powf(2.2);
            0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b)
        };
        let steps: Vec<f64> = (0..=60).map(|k| luminance(viridis(f64::from(k) / 60.0))).collect();
        assert!(steps.windows(2).all(|w| w[1] > w[0]), "{steps:?}");
        assert_eq!(hex(viridis(-1.0)), "#440154");
        assert_eq!(hex(viridis(2.0)), "#fde725");
        assert_eq!(hex(viridis(7.0 / 15.0)), "#23888e");
    }

    #[test]
    fn shading_darkens_and_groups_begin_again() {
        assert_eq!(shaded([200, 100, 50], 0.5), [100, 50, 25]);
        assert_eq!(group(0), group(10));
        assert_ne!(group(0), group(1));
    }
}
