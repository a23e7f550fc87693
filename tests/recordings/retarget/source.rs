//! A recording that can be rewritten.

use super::text;

/// A BVH file taken apart: header lines and rows of numbers.
#[derive(Clone)]
pub struct Source {
    pub header: Vec<String>,
    pub rows: Vec<Vec<f64>>,
    pub frame_time: f64,
}

impl Source {
    pub fn read(name: &str) -> Self {
        let t = text(name);
        let (header, motion) = t.split_once("MOTION").unwrap();
        let mut lines = motion.lines().filter(|l| !l.trim().is_empty());
        let _frames = lines.next().unwrap();
        let frame_time = lines
            .next()
            .unwrap()
            .rsplit(char::is_whitespace)
            .find(|w| !w.is_empty())
            .unwrap()
            .parse()
            .unwrap();
        Self {
            header: header
                .lines()
                .map(|l| l.trim().to_owned())
                .filter(|l| !l.is_empty())
                .collect(),
            rows: lines
                .map(|l| l.split_whitespace().map(|w| w.parse().unwrap()).collect())
                .collect(),
            frame_time,
        }
    }

    pub fn text(&self) -> String {
        let mut t = self.header.join("\n");
        t += &format!(
            "\nMOTION\nFrames: {}\nFrame Time: {}\n",
            self.rows.len(),
            self.frame_time
        );
        for r in &self.rows {
            t += &r
                .iter()
                .map(|x| format!("{x:.7}"))
                .collect::<Vec<_>>()
                .join(" ");
            t.push('\n');
        }
        t
    }

    pub fn renamed(mut self, names: &dyn Fn(&str) -> String) -> Self {
        for l in &mut self.header {
            for word in ["ROOT ", "JOINT "] {
                if let Some(name) = l.strip_prefix(word) {
                    *l = format!("{word}{}", names(name));
                }
            }
        }
        self
    }

    pub fn offsets(mut self, f: &dyn Fn([f64; 3]) -> [f64; 3]) -> Self {
        for l in &mut self.header {
            if let Some(numbers) = l.strip_prefix("OFFSET") {
                let v: Vec<f64> = numbers
                    .split_whitespace()
                    .map(|w| w.parse().unwrap())
                    .collect();
                let o = f([v[0], v[1], v[2]]);
                *l = format!("OFFSET {:.7} {:.7} {:.7}", o[0], o[1], o[2]);
            }
        }
        self
    }

    pub fn scaled(self, k: f64) -> Self {
        let mut s = self.offsets(&|o| o.map(|x| x * k));
        for r in &mut s.rows {
            r[..3].iter_mut().for_each(|x| *x *= k);
        }
        s
    }

    /// x → y → z → x: y up becomes z up.
    pub fn z_up(self) -> Self {
        let mut s = self.offsets(&|[x, y, z]| [z, x, y]);
        for l in &mut s.header {
            if l.starts_with("CHANNELS") {
                *l = l
                    .split_whitespace()
                    .map(|w| match w.split_at(1) {
                        ("X", rest) if rest.len() > 6 => format!("Y{rest}"),
                        ("Y", rest) if rest.len() > 6 => format!("Z{rest}"),
                        ("Z", rest) if rest.len() > 6 => format!("X{rest}"),
                        _ => w.to_owned(),
                    })
                    .collect::<Vec<_>>()
                    .join(" ");
            }
        }
        s
    }

    pub fn with_dead_root(mut self) -> Self {
        self.header[1] = self.header[1].replace("ROOT", "JOINT");
        let head = [
            "ROOT Reference",
            "{",
            "OFFSET 0 0 0",
            "CHANNELS 6 Xposition Yposition Zposition Zrotation Yrotation Xrotation",
        ];
        for (k, l) in head.into_iter().enumerate() {
            self.header.insert(1 + k, l.to_owned());
        }
        self.header.push("}".to_owned());
        for r in &mut self.rows {
            r.splice(0..0, [0.0; 6]);
        }
        self
    }

    pub fn with_t_pose(mut self, frames: usize) -> Self {
        let mut pose = vec![0.0; self.rows[0].len()];
        pose[..3].copy_from_slice(&self.rows[0][..3]);
        for _ in 0..frames {
            self.rows.insert(0, pose.clone());
        }
        self
    }
}
