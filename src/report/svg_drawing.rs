//! Draws the model as SVG: mesh, ring, balls, springs, dents, sensors, a scale bar and a key.
//!
//! A plane drawing of the model as plain data. Lengths in m, x to the right, y up, angles in rad counted
//! counter-clockwise from x.

use super::svg::{Path, ScaleBar};
use super::{ReportError, svg};
use serde::{Deserialize, Serialize};
use std::f64::consts::{FRAC_PI_2, PI};

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

/// Radius of a node, pixels.
const NODE_RADIUS: f64 = 2.2;
/// Looks of what stands in the key too.
const MESH: &str = "class=\"mesh\"";
const RACE: &str = "class=\"race\"";
const RING: &str = "class=\"ring\"";
const NODE: &str = "class=\"node\"";
const BALL: &str = "class=\"ball\"";
const DENTED: &str = "class=\"dent\"";

/// From metres to pixels.
#[derive(Debug, Clone, Copy)]
struct View {
    scale: f64,
    left: f64,
    low_x: f64,
    high_y: f64,
    height: f64,
}

impl View {
    fn of(drawing: &Drawing) -> Result<Self, ReportError> {
        let finite = extremes(drawing).all(|point| point.x.is_finite() && point.y.is_finite());
        let range = |of: fn(Point) -> f64| {
            let ends = [f64::INFINITY, f64::NEG_INFINITY];
            extremes(drawing).map(of).fold(ends, |[low, high], v| [low.min(v), high.max(v)])
        };
        let ([left, right], [bottom, top]) = (range(|point| point.x), range(|point| point.y));
        let (width, height) = (right - left, top - bottom);
        // Not "<= 0": an empty drawing has an extent of minus infinity, a wrong one NaN.
        if !(finite && width.max(height) > 0.0) {
            return Err(ReportError(format!(
                "drawing \"{}\" has no extent or a coordinate that is not finite",
                drawing.title
            )));
        }
        let scale = f64::min(MODEL[0] / width, MODEL[1] / height);
        Ok(Self {
            scale,
            left: MARGIN + 0.5 * (MODEL[0] - scale * width),
            low_x: left,
            high_y: top,
            height: (2.0 * MARGIN + scale * height + 18.0).max(300.0),
        })
    }

    fn px(&self, point: Point) -> [f64; 2] {
        [self.left + (point.x - self.low_x) * self.scale, MARGIN + (self.high_y - point.y) * self.scale]
    }
}

/// Points that bound the drawing.
fn extremes(drawing: &Drawing) -> impl Iterator<Item = Point> + '_ {
    let rings = || drawing.rings.iter();
    let circles = rings()
        .map(|r| r.circle)
        .chain(drawing.races.iter().copied())
        .chain(drawing.balls.iter().copied())
        .chain(drawing.dents.iter().map(|d| d.race));
    circles
        .flat_map(|c| (0..4).map(move |k| c.centre.polar(c.radius, f64::from(k) * FRAC_PI_2)))
        .chain(rings().flat_map(|r| r.nodes.iter().copied()))
        .chain(drawing.mesh_edges.iter().flatten().copied())
        .chain(drawing.springs.iter().map(|s| s.at))
        .chain(drawing.sensors.iter().map(|s| s.at))
}

/// The SVG element of a drawing.
pub(super) fn draw(drawing: &Drawing) -> Result<String, ReportError> {
    let view = View::of(drawing)?;
    let size = [WIDTH, view.height.round()];
    let mut out = svg::opening("class=\"drawing\"", size, &drawing.title);
    let mut mesh = Path::default();
    for edge in &drawing.mesh_edges {
        mesh.line(edge.iter().map(|p| view.px(*p)));
    }
    svg::path(&mut out, MESH, &mesh.data, "");
    for spring in &drawing.springs {
        draw_spring(&mut out, view.px(spring.at), spring.towards_rad);
    }
    for race in &drawing.races {
        circle(&mut out, RACE, &view, race);
    }
    for ring in &drawing.rings {
        circle(&mut out, RING, &view, &ring.circle);
        for node in &ring.nodes {
            svg::circle(&mut out, NODE, view.px(*node), NODE_RADIUS, "");
        }
    }
    for ball in &drawing.balls {
        circle(&mut out, BALL, &view, ball);
    }
    for dent in &drawing.dents {
        draw_dent(&mut out, &view, dent);
    }
    for sensor in &drawing.sensors {
        draw_sensor(&mut out, view.px(sensor.at), sensor.direction_rad, &sensor.name);
    }
    scale_and_axes(&mut out, &view);
    key(&mut out, drawing);
    Ok(out + "</svg>")
}

fn circle(out: &mut String, look: &str, view: &View, circle: &Circle) {
    let radius = circle.radius * view.scale;
    svg::circle(out, look, view.px(circle.centre), radius, "");
}

/// A coil from the attachment to a hatched line, drawn at a fixed size.
fn draw_spring(out: &mut String, [x, y]: [f64; 2], towards_rad: f64) {
    let (s, c) = towards_rad.sin_cos();
    // Pixels count downwards.
    let place = |[along, across]: [f64; 2]| [x + c * along - s * across, y - s * along - c * across];
    let turn = |k: usize| {
        let side = if k.is_multiple_of(2) { 3.4 } else { -3.4 };
        [COIL * (0.25 + 0.1 * k as f64), side]
    };
    let begin = [[0.0, 0.0], [0.2 * COIL, 0.0]].into_iter();
    let end = [[0.8 * COIL, 0.0], [COIL, 0.0]];
    let mut coil = Path::default();
    coil.line(begin.chain((0..6).map(turn)).chain(end).map(place));
    svg::path(out, "class=\"spring\"", &coil.data, "");
    let mut ground = Path::default();
    ground.line([[COIL, -5.0], [COIL, 5.0]].map(place));
    for across in [-3.0, 1.0, 5.0] {
        ground.line([[COIL, across], [COIL + 4.0, across - 3.0]].map(place));
    }
    svg::path(out, "class=\"ground\"", &ground.data, "");
}

/// The dent's arc on its race.
fn draw_dent(out: &mut String, view: &View, dent: &Dent) {
    let race = dent.race;
    let least = DENT / view.scale;
    let half = 0.5 * dent.length.max(least) / race.radius.max(least);
    let mut arc = Path::default();
    arc.line((0..=12).map(|k| {
        let angle = dent.angle_rad + half * (f64::from(k) / 6.0 - 1.0);
        view.px(race.centre.polar(race.radius, angle))
    }));
    svg::path(out, DENTED, &arc.data, "");
}

/// An arrow from the sensor's place in the direction in which it measures, with the name at its tip; a dot in a circle,
/// the name beside it, for one that measures across the drawing.
fn draw_sensor(out: &mut String, [x, y]: [f64; 2], direction_rad: Option<f64>, name: &str) {
    out.push_str("<g class=\"sensor\">");
    svg::circle(out, "", [x, y], 3.5, "");
    if let Some(angle) = direction_rad {
        let (s, c) = angle.sin_cos();
        let tip = [x + ARROW * c, y - ARROW * s];
        svg::line(out, "", [x, y, tip[0] - 6.0 * c, tip[1] + 6.0 * s]);
        let mut head = Path::default();
        head.line([(0.85 * PI, 11.0), (0.0, 0.0), (-0.85 * PI, 11.0)].map(|(turn, length)| {
            let (s, c) = (angle + turn).sin_cos();
            [tip[0] + length * c, tip[1] - length * s]
        }));
        svg::path(out, "", &(head.data + "Z"), "");
        let look = match c {
            c if c > 0.5 => "",
            c if c < -0.5 => svg::END,
            _ => svg::MIDDLE,
        };
        let beside = [tip[0] + 10.0 * c, tip[1] - 10.0 * s + 4.0];
        svg::text(out, look, beside, name);
    } else {
        let look = "style=\"fill:none;stroke:currentColor\"";
        svg::circle(out, look, [x, y], 7.5, "");
        svg::text(out, "", [x + 13.0, y + 4.0], name);
    }
    out.push_str("</g>");
}

/// A bar of a round length and the directions of x and y, at the lower left.
fn scale_and_axes(out: &mut String, view: &View) {
    let bar = ScaleBar::of(view.scale);
    let (x, y) = (18.0, view.height - 16.0);
    out.push_str("<g class=\"scale\">");
    bar.draw(out, [x, y]);
    svg::text(out, "", [x + bar.pixels + 8.0, y], &bar.label);
    // both axes from one corner, each with the two strokes of its head
    let (low, high, far) = (y - 22.0, y - 52.0, x + 30.0);
    let mut axes = Path::default();
    axes.line([[x, low], [x, high]]);
    axes.line([[x - 3.5, high + 7.0], [x, high], [x + 3.5, high + 7.0]]);
    axes.line([[x, low], [far, low]]);
    axes.line([[far - 7.0, low - 3.5], [far, low], [far - 7.0, low + 3.5]]);
    svg::path(out, "", &axes.data, "");
    svg::text(out, "", [far + 4.0, low + 4.0], "x");
    svg::text(out, svg::MIDDLE, [x, high - 4.0], "y");
    out.push_str("</g>");
}

/// What the signs mean, at the right; only for what the drawing has.
fn key(out: &mut String, drawing: &Drawing) {
    let count = |n: usize, one: &str| format!("{n} {one}{}", if n == 1 { "" } else { "s" });
    let stroke = |look: &'static str| {
        move |out: &mut String, [x, y]: [f64; 2]| {
            svg::path(out, look, &format!("M{} {y}H{}", x - 13.0, x + 13.0), "");
        }
    };
    let mesh = |out: &mut String, [x, y]: [f64; 2]| {
        svg::path(out, MESH, &format!("M{} {}h20v16h-20zm10 0v16m-10 -8h20", x - 10.0, y - 8.0), "");
    };
    let ring = |out: &mut String, [x, y]: [f64; 2]| {
        stroke(RING)(out, [x, y]);
        svg::circle(out, NODE, [x - 8.0, y], NODE_RADIUS, "");
        svg::circle(out, NODE, [x + 8.0, y], NODE_RADIUS, "");
    };
    let ball = |out: &mut String, at| svg::circle(out, BALL, at, 8.0, "");
    let spring = |out: &mut String, [x, y]: [f64; 2]| draw_spring(out, [x, y - 11.0], -FRAC_PI_2);
    let sensor = |out: &mut String, [x, y]: [f64; 2]| draw_sensor(out, [x - 28.0, y], Some(0.0), "");
    let nodes = drawing.rings.iter().map(|ring| ring.nodes.len()).sum();
    let rings = if drawing.rings.len() > 1 { "bearing rings" } else { "bearing ring" };
    // each sign, how many there are, and what it is
    type Sign<'a> = &'a dyn Fn(&mut String, [f64; 2]);
    let entries: [(Sign<'_>, usize, String); 7] = [
        (&mesh, drawing.mesh_edges.len(), "housing mesh".to_owned()),
        (&ring, drawing.rings.len(), format!("{rings}, {}", count(nodes, "node"))),
        (&stroke(RACE), drawing.races.len(), "races".to_owned()),
        (&ball, drawing.balls.len(), count(drawing.balls.len(), "ball")),
        (&spring, drawing.springs.len(), count(drawing.springs.len(), "support spring")),
        (&stroke(DENTED), drawing.dents.len(), count(drawing.dents.len(), "dent")),
        (&sensor, drawing.sensors.len(), count(drawing.sensors.len(), "sensor")),
    ];
    let mut y = 60.0;
    for (sign, _, text) in entries.iter().filter(|entry| entry.1 > 0) {
        sign(out, [KEY + 14.0, y]);
        svg::text(out, "class=\"key\"", [KEY + 40.0, y + 4.0], text);
        y += 30.0;
    }
    // over the balls they would hide these
    for (number, dent) in drawing.dents.iter().enumerate() {
        svg::text(out, "class=\"dent-label\"", [KEY, y + 18.0 * number as f64], &dent.label);
    }
}

/// A point in the plane of the bearing.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// To the right, m.
    pub x: f64,
    /// Up, m.
    pub y: f64,
}

/// A circle: a race, a ball, the shaft.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Circle {
    /// Its centre.
    pub centre: Point,
    /// Its radius, m.
    pub radius: f64,
}

/// The finite-element ring.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Ring {
    /// Its centre line.
    pub circle: Circle,
    /// Its nodes.
    pub nodes: Vec<Point>,
}

/// A support spring: from its attachment towards the ground.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Spring {
    /// Where it holds the model.
    pub at: Point,
    /// Direction from there to the ground, rad.
    pub towards_rad: f64,
}

/// A dent on a race.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Dent {
    /// The race it lies on.
    pub race: Circle,
    /// Angle of its middle, rad.
    pub angle_rad: f64,
    /// Its length along the race, m; drawn no shorter than can be seen.
    pub length: f64,
    /// What stands beside it.
    pub label: String,
}

/// A sensor: an arrow at its place, a ring and a dot if it measures across the drawing.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Sensor {
    /// Its name.
    pub name: String,
    /// Its place.
    pub at: Point,
    /// Direction in which it measures, rad; `None`: across the drawing.
    pub direction_rad: Option<f64>,
}

/// A drawing of the model. Whatever is empty is left out, of the key too.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Drawing {
    /// What it shows.
    pub title: String,
    /// What to see in it, under the drawing.
    pub caption: Option<String>,
    /// Edges of the mesh as lines through points.
    pub mesh_edges: Vec<Vec<Point>>,
    /// The finite-element rings.
    pub rings: Vec<Ring>,
    /// Races and shaft: circles without filling.
    pub races: Vec<Circle>,
    /// Balls: filled circles.
    pub balls: Vec<Circle>,
    /// Support springs.
    pub springs: Vec<Spring>,
    /// Dents.
    pub dents: Vec<Dent>,
    /// Sensors.
    pub sensors: Vec<Sensor>,
}

impl Point {
    /// The point at a distance `radius` (m) and angle (rad) from this one.
    pub(crate) fn polar(self, radius: f64, angle_rad: f64) -> Self {
        Self { x: self.x + radius * angle_rad.cos(), y: self.y + radius * angle_rad.sin() }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Sensor, Spring};
    use super::*;
    use crate::report::svg_drawing::Ring;

    const CENTRE: Point = Point { x: 0.0, y: 0.0 };

    fn drawing() -> Drawing {
        let race = Circle { centre: CENTRE, radius: 4e-3 };
        Drawing {
            title: "Bearing <1>".to_owned(),
            mesh_edges: vec![vec![CENTRE.polar(6e-3, 0.0), CENTRE.polar(9e-3, 0.0)]],
            rings: vec![Ring {
                circle: Circle { centre: CENTRE, radius: 5e-3 },
                nodes: (0..72).map(|k| CENTRE.polar(5e-3, f64::from(k) * PI / 36.0)).collect(),
            }],
            races: vec![race],
            balls: (0..7).map(|k| Circle { centre: CENTRE.polar(3e-3, f64::from(k)), radius: 1e-3 }).collect(),
            springs: (0..36)
                .map(|k| Spring { at: CENTRE.polar(9e-3, -f64::from(k) * 0.08), towards_rad: -FRAC_PI_2 })
                .collect(),
            dents: vec![Dent { race, angle_rad: -FRAC_PI_2, length: 0.75e-3, label: "dent & rim".to_owned() }],
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
            // below the seven signs of the key
            " x=\"690.0\" y=\"270.0\">dent &amp; rim<",
            "1 sensor<",
            "Bearing &lt;1&gt;",
            ">5 mm<",
        ] {
            assert!(svg.contains(text), "{text}");
        }
        let bare = Drawing { balls: vec![], springs: vec![], ..drawing() };
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
        let error = draw(&Drawing { title: "d".to_owned(), ..Drawing::default() }).expect_err("must fail");
        assert_eq!(error.to_string(), "drawing \"d\" has no extent or a coordinate that is not finite");
        let mut wrong = drawing();
        wrong.balls[0].radius = f64::NAN;
        assert!(draw(&wrong).is_err());
    }
}
