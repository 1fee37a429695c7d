//! Draws the model as SVG: mesh, ring, balls, springs, dents, sensors, a scale bar and a key.

use std::f64::consts::{FRAC_PI_2, PI};
use std::fmt::Write;

use super::ReportError;
use super::drawing::{Dent, Drawing, Point, Sensor, Spring};
use super::number::display_unit;
use super::svg::{Path, escape};

const WIDTH: f64 = 920.0;
/// Largest width and height of the model on the page, pixels.
const MODEL: [f64; 2] = [500.0, 470.0];
/// Room round the model for springs, arrows and labels, pixels.
const MARGIN: f64 = 76.0;
/// Left edge of the key, pixels.
const KEY: f64 = 690.0;
/// Length of a spring's coil, pixels.
const COIL: f64 = 18.0;
/// Shortest dent that can be seen, pixels.
const DENT: f64 = 9.0;
/// Length of a sensor's arrow, pixels.
const ARROW: f64 = 42.0;

/// From metres to pixels.
#[derive(Debug, Clone, Copy)]
struct View {
    scale: f64,
    left: f64,
    top: f64,
    low_x: f64,
    high_y: f64,
    height: f64,
}

impl View {
    fn of(drawing: &Drawing) -> Result<Self, ReportError> {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        let mut finite = true;
        for point in extremes(drawing) {
            for (k, v) in [point.x, point.y].into_iter().enumerate() {
                finite &= v.is_finite();
                low[k] = low[k].min(v);
                high[k] = high[k].max(v);
            }
        }
        let (width, height) = (high[0] - low[0], high[1] - low[1]);
        // Not "<= 0": an empty drawing has an extent of minus infinity, a wrong one NaN.
        if !(finite && width.max(height) > 0.0) {
            return Err(ReportError::Extent {
                drawing: drawing.title.clone(),
            });
        }
        let scale = f64::min(MODEL[0] / width, MODEL[1] / height);
        Ok(Self {
            scale,
            left: MARGIN + 0.5 * (MODEL[0] - scale * width),
            top: MARGIN,
            low_x: low[0],
            high_y: high[1],
            height: (2.0 * MARGIN + scale * height + 18.0).max(300.0),
        })
    }

    fn px(&self, point: Point) -> [f64; 2] {
        [
            self.left + (point.x - self.low_x) * self.scale,
            self.top + (self.high_y - point.y) * self.scale,
        ]
    }
}

/// Points that bound the drawing.
fn extremes(drawing: &Drawing) -> impl Iterator<Item = Point> + '_ {
    let ring = drawing.ring.iter();
    let circles = ring
        .clone()
        .map(|r| r.circle)
        .chain(drawing.races.iter().copied())
        .chain(drawing.balls.iter().copied())
        .chain(drawing.dents.iter().map(|d| d.race));
    circles
        .flat_map(|c| (0..4).map(move |k| c.centre.polar(c.radius, f64::from(k) * FRAC_PI_2)))
        .chain(ring.flat_map(|r| r.nodes.iter().copied()))
        .chain(drawing.mesh_edges.iter().flatten().copied())
        .chain(drawing.springs.iter().map(|s| s.at))
        .chain(drawing.sensors.iter().map(|s| s.at))
}

/// The SVG element of a drawing.
pub(super) fn draw(drawing: &Drawing) -> Result<String, ReportError> {
    let view = View::of(drawing)?;
    let mut out = format!(
        "<svg class=\"drawing\" viewBox=\"0 0 {WIDTH} {:.0}\" role=\"img\" aria-label=\"{}\">",
        view.height,
        escape(&drawing.title)
    );
    let mut mesh = Path::default();
    for edge in &drawing.mesh_edges {
        mesh.gap();
        for [x, y] in edge.iter().map(|p| view.px(*p)) {
            mesh.to(x, y);
        }
    }
    // Writing to a string cannot fail, here and below.
    let _ = write!(out, "<path class=\"mesh\" d=\"{}\"/>", mesh.data());
    for spring in &drawing.springs {
        draw_spring(&mut out, view.px(spring.at), spring);
    }
    for race in &drawing.races {
        circle(
            &mut out,
            "race",
            view.px(race.centre),
            race.radius * view.scale,
        );
    }
    if let Some(ring) = &drawing.ring {
        let radius = ring.circle.radius * view.scale;
        circle(&mut out, "ring", view.px(ring.circle.centre), radius);
        for node in &ring.nodes {
            circle(&mut out, "node", view.px(*node), 2.2);
        }
    }
    for ball in &drawing.balls {
        circle(
            &mut out,
            "ball",
            view.px(ball.centre),
            ball.radius * view.scale,
        );
    }
    for dent in &drawing.dents {
        draw_dent(&mut out, &view, dent);
    }
    for sensor in &drawing.sensors {
        draw_sensor(&mut out, view.px(sensor.at), sensor);
    }
    scale_bar(&mut out, &view);
    key(&mut out, drawing);
    out.push_str("</svg>");
    Ok(out)
}

fn circle(out: &mut String, class: &str, [x, y]: [f64; 2], radius: f64) {
    let _ = write!(
        out,
        "<circle class=\"{class}\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius:.1}\"/>"
    );
}

/// A coil from the attachment to a hatched line, drawn at a fixed size.
fn draw_spring(out: &mut String, [x, y]: [f64; 2], spring: &Spring) {
    let mut coil = Path::default();
    let place = |along: f64, across: f64| {
        let (s, c) = spring.towards_rad.sin_cos();
        // Pixels count downwards.
        [x + c * along - s * across, y - s * along - c * across]
    };
    let mut go = |along, across| {
        let [x, y] = place(along, across);
        coil.to(x, y);
    };
    go(0.0, 0.0);
    go(0.2 * COIL, 0.0);
    for k in 0..6 {
        let side = if k % 2 == 0 { 3.4 } else { -3.4 };
        go(COIL * (0.25 + 0.1 * f64::from(k)), side);
    }
    go(0.8 * COIL, 0.0);
    go(COIL, 0.0);
    let _ = write!(out, "<path class=\"spring\" d=\"{}\"/>", coil.data());
    let mut ground = Path::default();
    for (along, across) in [(0.0, -5.0), (0.0, 5.0)] {
        let [x, y] = place(COIL + along, across);
        ground.to(x, y);
    }
    for across in [-3.0, 1.0, 5.0] {
        ground.gap();
        for [x, y] in [place(COIL, across), place(COIL + 4.0, across - 3.0)] {
            ground.to(x, y);
        }
    }
    let _ = write!(out, "<path class=\"ground\" d=\"{}\"/>", ground.data());
}

/// The dent's arc on its race, and its label towards the centre.
fn draw_dent(out: &mut String, view: &View, dent: &Dent) {
    let race = dent.race;
    let least = DENT / view.scale;
    let half = 0.5 * dent.length.max(least) / race.radius.max(least);
    let mut arc = Path::default();
    for k in 0..=12 {
        let angle = dent.angle_rad + half * (f64::from(k) / 6.0 - 1.0);
        let [x, y] = view.px(race.centre.polar(race.radius, angle));
        arc.to(x, y);
    }
    let [x1, y1] = view.px(race.centre.polar(0.97 * race.radius, dent.angle_rad));
    let [x2, y2] = view.px(race.centre.polar(0.22 * race.radius, dent.angle_rad));
    let below = if dent.angle_rad.sin() < 0.0 {
        -6.0
    } else {
        14.0
    };
    let _ = write!(
        out,
        "<path class=\"dent\" d=\"{}\"/><line class=\"leader\" x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\"/>\
         <text class=\"dent-label\" x=\"{x2:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>",
        arc.data(),
        y2 + below,
        escape(&dent.label)
    );
}

/// An arrow from the sensor's place in the direction in which it measures, with the name at its tip; a dot in a circle,
/// the name beside it, for one that measures across the drawing.
fn draw_sensor(out: &mut String, [x, y]: [f64; 2], sensor: &Sensor) {
    let Some(angle) = sensor.direction_rad else {
        let _ = write!(
            out,
            "<g class=\"sensor\"><circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3.5\"/>\
             <circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"7.5\" style=\"fill:none;stroke:currentColor\"/>\
             <text x=\"{:.1}\" y=\"{:.1}\">{}</text></g>",
            x + 13.0,
            y + 4.0,
            escape(&sensor.name)
        );
        return;
    };
    let (s, c) = angle.sin_cos();
    let tip = [x + ARROW * c, y - ARROW * s];
    let mut head = Path::default();
    for turn in [0.85 * PI, 0.0, -0.85 * PI] {
        let length = if turn.abs() > 0.0 { 11.0 } else { 0.0 };
        let (s, c) = (angle + turn).sin_cos();
        head.to(tip[0] + length * c, tip[1] - length * s);
    }
    let anchor = match c {
        c if c > 0.5 => "start",
        c if c < -0.5 => "end",
        _ => "middle",
    };
    let _ = write!(
        out,
        "<g class=\"sensor\"><circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3.5\"/><line x1=\"{x:.1}\" y1=\"{y:.1}\" x2=\"{:.1}\" y2=\"{:.1}\"/>\
         <path d=\"{}Z\"/><text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"{anchor}\">{}</text></g>",
        tip[0] - 6.0 * c,
        tip[1] + 6.0 * s,
        head.data(),
        tip[0] + 10.0 * c,
        tip[1] - 10.0 * s + 4.0,
        escape(&sensor.name)
    );
}

/// A bar of a round length and the directions of x and y, at the lower left.
fn scale_bar(out: &mut String, view: &View) {
    let length = round_length(110.0 / view.scale);
    let unit = display_unit("m", length);
    let (x, y, pixels) = (18.0, view.height - 16.0, length * view.scale);
    let _ = write!(
        out,
        "<g class=\"scale\"><path d=\"M{x} {y1}V{y}H{right:.1}V{y1}\"/><text x=\"{text:.1}\" y=\"{y}\">{shown:.0} {unit}</text>\
         <path d=\"M{x} {low}V{high}M{a} {b}L{x} {high}L{c} {b}M{x} {low}H{far}M{d} {e}L{far} {low}L{d} {f}\"/>\
         <text x=\"{far_text}\" y=\"{low_text}\">x</text><text x=\"{y_text}\" y=\"{high_text}\" text-anchor=\"middle\">y</text></g>",
        y1 = y - 5.0,
        right = x + pixels,
        text = x + pixels + 8.0,
        shown = length / unit.factor,
        unit = unit.text,
        low = y - 22.0,
        high = y - 52.0,
        a = x - 3.5,
        b = y - 45.0,
        c = x + 3.5,
        far = x + 30.0,
        d = x + 23.0,
        e = y - 25.5,
        f = y - 18.5,
        far_text = x + 34.0,
        low_text = y - 18.0,
        y_text = x,
        high_text = y - 56.0,
    );
}

/// The nearest of 1, 2 or 5 times a power of ten.
pub(super) fn round_length(wanted: f64) -> f64 {
    let power = 10_f64.powf(wanted.log10().floor());
    let far = |nice: f64| (nice * power / wanted).ln().abs();
    let nearest = [1.0, 2.0, 5.0, 10.0]
        .into_iter()
        .min_by(|a, b| far(*a).total_cmp(&far(*b)));
    nearest.unwrap_or(1.0) * power
}

/// What the signs mean, at the right; only for what the drawing has.
fn key(out: &mut String, drawing: &Drawing) {
    let count =
        |n: usize, one: &str, many: &str| format!("{n} {}", if n == 1 { one } else { many });
    let mut y = 60.0;
    let mut entry = |sign: &dyn Fn(&mut String, [f64; 2]), text: String| {
        sign(out, [KEY + 14.0, y]);
        let (x, text_y) = (KEY + 40.0, y + 4.0);
        let _ = write!(
            out,
            "<text class=\"key\" x=\"{x}\" y=\"{text_y}\">{text}</text>"
        );
        y += 30.0;
    };
    let stroke = |class: &'static str| {
        move |out: &mut String, [x, y]: [f64; 2]| {
            let (x1, x2) = (x - 13.0, x + 13.0);
            let _ = write!(out, "<path class=\"{class}\" d=\"M{x1} {y}H{x2}\"/>");
        }
    };
    if !drawing.mesh_edges.is_empty() {
        let sign = |out: &mut String, [x, y]: [f64; 2]| {
            let (x, y) = (x - 10.0, y - 8.0);
            let _ = write!(
                out,
                "<path class=\"mesh\" d=\"M{x} {y}h20v16h-20zm10 0v16m-10 -8h20\"/>"
            );
        };
        entry(&sign, "housing mesh".to_owned());
    }
    if let Some(ring) = &drawing.ring {
        let sign = |out: &mut String, [x, y]: [f64; 2]| {
            stroke("ring")(out, [x, y]);
            circle(out, "node", [x - 8.0, y], 2.2);
            circle(out, "node", [x + 8.0, y], 2.2);
        };
        entry(
            &sign,
            format!("bearing ring, {}", count(ring.nodes.len(), "node", "nodes")),
        );
    }
    if !drawing.races.is_empty() {
        entry(&stroke("race"), "races".to_owned());
    }
    if !drawing.balls.is_empty() {
        let sign = |out: &mut String, at| circle(out, "ball", at, 8.0);
        entry(&sign, count(drawing.balls.len(), "ball", "balls"));
    }
    if !drawing.springs.is_empty() {
        let down = Spring {
            at: Point { x: 0.0, y: 0.0 },
            towards_rad: -FRAC_PI_2,
        };
        let sign = |out: &mut String, [x, y]: [f64; 2]| draw_spring(out, [x, y - 11.0], &down);
        entry(
            &sign,
            count(drawing.springs.len(), "support spring", "support springs"),
        );
    }
    if !drawing.dents.is_empty() {
        entry(&stroke("dent"), count(drawing.dents.len(), "dent", "dents"));
    }
    if !drawing.sensors.is_empty() {
        let sign = |out: &mut String, [x, y]: [f64; 2]| {
            let right = Sensor {
                name: String::new(),
                at: Point { x: 0.0, y: 0.0 },
                direction_rad: Some(0.0),
            };
            draw_sensor(out, [x - 28.0, y], &right);
        };
        entry(&sign, count(drawing.sensors.len(), "sensor", "sensors"));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::{Circle, Ring};

    const CENTRE: Point = Point { x: 0.0, y: 0.0 };

    fn drawing() -> Drawing {
        let race = Circle {
            centre: CENTRE,
            radius: 4e-3,
        };
        Drawing {
            title: "Bearing <1>".to_owned(),
            mesh_edges: vec![vec![CENTRE.polar(6e-3, 0.0), CENTRE.polar(9e-3, 0.0)]],
            ring: Some(Ring {
                circle: Circle {
                    centre: CENTRE,
                    radius: 5e-3,
                },
                nodes: (0..72)
                    .map(|k| CENTRE.polar(5e-3, f64::from(k) * PI / 36.0))
                    .collect(),
            }),
            races: vec![race],
            balls: (0..7)
                .map(|k| Circle {
                    centre: CENTRE.polar(3e-3, f64::from(k)),
                    radius: 1e-3,
                })
                .collect(),
            springs: (0..36)
                .map(|k| Spring {
                    at: CENTRE.polar(9e-3, -f64::from(k) * 0.08),
                    towards_rad: -FRAC_PI_2,
                })
                .collect(),
            dents: vec![Dent {
                race,
                angle_rad: -FRAC_PI_2,
                length: 0.75e-3,
                label: "dent & rim".to_owned(),
            }],
            sensors: vec![Sensor {
                name: "P1".to_owned(),
                at: CENTRE.polar(9e-3, FRAC_PI_2),
                direction_rad: Some(FRAC_PI_2),
            }],
            ..Drawing::default()
        }
    }

    #[test]
    fn everything_is_drawn_once_and_named_in_the_key() {
        let svg = draw(&drawing()).expect("a valid drawing");
        let count = |what: &str| svg.matches(what).count();
        assert_eq!(count("class=\"ball\""), 7 + 1);
        assert_eq!(count("class=\"node\""), 72 + 2);
        assert_eq!(count("class=\"spring\""), 36 + 1);
        assert_eq!(count("class=\"sensor\""), 1 + 1);
        for text in [
            "bearing ring, 72 nodes",
            "7 balls",
            "36 support springs",
            "1 dent<",
            "1 sensor<",
            "dent &amp; rim",
            "Bearing &lt;1&gt;",
            ">5 mm<",
        ] {
            assert!(svg.contains(text), "{text}");
        }
        let bare = Drawing {
            balls: vec![],
            springs: vec![],
            ..drawing()
        };
        let svg = draw(&bare).expect("a valid drawing");
        assert!(!svg.contains("balls") && !svg.contains("spring"));
    }

    #[test]
    fn up_is_up_and_lengths_keep_their_ratio() {
        let view = View::of(&drawing()).expect("a valid drawing");
        let ([x0, y0], [x1, y1]) = (view.px(CENTRE), view.px(Point { x: 1e-3, y: 2e-3 }));
        assert!(x1 > x0 && y1 < y0);
        assert!(((y0 - y1) / (x1 - x0) - 2.0).abs() < 1e-9);
    }

    #[test]
    fn nothing_and_nonsense_are_refused() {
        let error = draw(&Drawing {
            title: "d".to_owned(),
            ..Drawing::default()
        })
        .expect_err("must fail");
        assert_eq!(
            error.to_string(),
            "drawing \"d\" has no extent or a coordinate that is not finite"
        );
        let mut wrong = drawing();
        wrong.balls[0].radius = f64::NAN;
        assert!(draw(&wrong).is_err());
    }
}
