//! What is loose, in words.

use super::{Body, Joint, Mechanisms, Piece};

/// Most node tags in a sentence.
const MOST_TAGS: usize = 6;

impl Mechanisms {
    /// A sentence for each piece and joint with motions that a designer may not have meant. Empty for a housing in one
    /// piece that is free or held.
    pub fn sentences(&self) -> Vec<String> {
        let full = if self.dimension == 2 { 3 } else { 6 };
        let mut main = self.of_whole > 0;
        let mut found = Vec::new();
        for (number, piece) in self.pieces.iter().enumerate() {
            let what = self.piece_name(piece);
            if piece.rigid == full {
                if !std::mem::take(&mut main) {
                    found.push(format!("{what} is not connected: {}", counted(piece.rigid, "extra rigid mode")));
                }
            } else if piece.rigid > 0 {
                let motions = if piece.rigid == 1 { "motion" } else { "motions" };
                found.push(format!("{what} is held, but can still move: {} {motions} without stiffness", piece.rigid));
            }
            if piece.internal > 0 {
                found.extend(self.joint_sentences(number, piece.internal));
            }
        }
        found
    }

    fn joint_sentences(&self, piece: usize, internal: usize) -> Vec<String> {
        let own = |joint: &&Joint| {
            let first = joint.bodies.first().and_then(|&body| self.bodies.get(body));
            first.is_some_and(|body| body.piece == piece)
        };
        let joints: Vec<&Joint> = self.joints.iter().filter(own).collect();
        let alone: usize = joints.iter().map(|joint| joint.motions).sum();
        let each = alone == internal;
        let by_itself = if each { "" } else { " by itself" };
        let sentence =
            |joint: &&Joint| format!("{}: {}{by_itself}", self.joined(joint), counted(joint.motions, "mechanism"));
        let mut found: Vec<String> = joints.iter().map(sentence).collect();
        if !each {
            found.push(format!("these joints together leave {}", counted(internal, "mechanism")));
        }
        found
    }

    fn joined(&self, joint: &Joint) -> String {
        let names: Vec<String> = joint.bodies.iter().map(|&body| self.short_name(body)).collect();
        let names = names.join(" and ");
        let tags: Vec<String> = joint.nodes.iter().take(MOST_TAGS).map(ToString::to_string).collect();
        let more = if joint.nodes.len() > MOST_TAGS { ", ..." } else { "" };
        let tags = format!("{}{more}", tags.join(", "));
        let only_nodes = joint.links.is_empty() && !joint.tied;
        match joint.nodes.len() {
            1 if only_nodes => format!("{names} are joined at a single node only (node {tags})"),
            2.. if only_nodes => format!("{names} are joined along an edge only (nodes {tags})"),
            _ => {
                let mut by: Vec<String> = Vec::new();
                if !joint.nodes.is_empty() {
                    by.push(format!("nodes {tags}"));
                }
                by.extend(joint.links.iter().map(|link| format!("springs of the link \"{link}\"")));
                if joint.tied {
                    by.push("a tie".to_owned());
                }
                format!("{names} are joined by {} and can still move", by.join(" and "))
            }
        }
    }

    /// Name, size and place of a piece by its largest body.
    fn piece_name(&self, piece: &Piece) -> String {
        let Some(body) = piece.bodies.first().and_then(|&body| self.bodies.get(body)) else {
            return String::new();
        };
        let others = match piece.bodies.len() {
            0 | 1 => String::new(),
            2 => " with 1 body more".to_owned(),
            count => format!(" with {} bodies more", count - 1),
        };
        if body.is_ring {
            return format!("{}{others}", body.ring_name);
        }
        let word = if body.parts.len() > 1 { "parts" } else { "part" };
        let elements = match piece.elements {
            1 => "1 element".to_owned(),
            count => format!("{} elements", grouped(count)),
        };
        let place = self.place(body);
        format!("{word} {}{others} ({elements}, near {place})", quoted(&body.parts))
    }

    /// A body's parts, and its place if another body has the same ones.
    fn short_name(&self, body: usize) -> String {
        let Some(own) = self.bodies.get(body) else {
            return String::new();
        };
        if own.is_ring {
            return own.ring_name.clone();
        }
        let name = quoted(&own.parts);
        let alike = self.bodies.iter().filter(|other| other.parts == own.parts).count();
        match alike {
            0 | 1 => name,
            _ => format!("{name} near {}", self.place(own)),
        }
    }

    fn place(&self, body: &Body) -> String {
        let axes = ["x", "y", "z"].into_iter().zip(body.centroid);
        let places = axes.take(self.dimension).map(|(axis, value)| format!("{axis} = {value:.4}"));
        format!("{} m", places.collect::<Vec<_>>().join(", "))
    }
}

fn quoted(names: &[String]) -> String {
    let quoted: Vec<String> = names.iter().map(|name| format!("\"{name}\"")).collect();
    quoted.join(", ")
}

fn counted(count: usize, what: &str) -> String {
    let plural = if count == 1 { "" } else { "s" };
    format!("{count} {what}{plural}")
}

/// Digits in groups of three.
fn grouped(number: usize) -> String {
    let digits = number.to_string();
    let groups = digits.as_bytes().rchunks(3).rev();
    groups.map(String::from_utf8_lossy).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::grouped;

    #[test]
    fn digits_stand_in_threes() {
        let texts = [7, 140, 2_140, 1_002_140].map(grouped);
        assert_eq!(texts, ["7", "140", "2 140", "1 002 140"]);
    }
}
