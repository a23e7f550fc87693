//! Survival maps: the share of several cases that are survived, by two quantities, as a table of colours.

/// Shares of survivors by row and column.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SurvivalMap {
    /// Heading.
    pub title: String,
    /// Meaning of the rows, and of the columns.
    pub axes: [String; 2],
    /// Names of the rows and of the columns.
    pub rows: Vec<String>,
    /// See `rows`.
    pub columns: Vec<String>,
    /// By row, then by column: survivors, and number of tries.
    pub cells: Vec<Vec<[u32; 2]>>,
}

impl SurvivalMap {
    /// Survivors and tries of the whole map.
    pub fn total(&self) -> [u32; 2] {
        let all = self.cells.iter().flatten();
        all.fold([0, 0], |[a, b], [c, d]| [a + c, b + d])
    }

    /// Survivors and tries of a column.
    pub fn column(&self, k: usize) -> [u32; 2] {
        let all = self.cells.iter().filter_map(|row| row.get(k));
        all.fold([0, 0], |[a, b], [c, d]| [a + c, b + d])
    }

    /// The map as a self-contained SVG document.
    pub fn svg(&self) -> String {
        use svg::node::element::{Rectangle, Text};
        const CELL: f64 = 46.0;
        const ROW: f64 = 26.0;
        const LEFT: f64 = 74.0;
        const TOP: f64 = 44.0;
        const BOTTOM: f64 = 22.0;
        let width = (LEFT + CELL * self.columns.len() as f64 + 14.0).max(460.0);
        let height = TOP + ROW * self.rows.len() as f64 + BOTTOM;
        let text = |text: &str, x: f64, y: f64| Text::new(text).set("x", x).set("y", y);
        let paper = Rectangle::new()
            .set("width", "100%")
            .set("height", "100%")
            .set("fill", "#fbfbf9");
        let title = text(&self.title, 10.0, 15.0)
            .set("font-size", 13)
            .set("font-weight", 600);
        let mut out = svg::Document::new()
            .set("viewBox", (0, 0, width, height))
            .set("width", width)
            .set("height", height)
            .set("font-family", "system-ui, sans-serif")
            .set("font-size", 11)
            .set("fill", "#33373d")
            .add(paper)
            .add(title)
            .add(text(&self.axes[1], LEFT, height - 6.0))
            .add(text(&self.axes[0], 10.0, TOP - 6.0));
        for (k, name) in self.columns.iter().enumerate() {
            let x = LEFT + CELL * (k as f64 + 0.5);
            out = out.add(text(name, x, TOP - 6.0).set("text-anchor", "middle"));
        }
        for (i, (name, row)) in self.rows.iter().zip(&self.cells).enumerate() {
            let y = TOP + ROW * i as f64;
            out = out.add(text(name, LEFT - 8.0, y + 17.0).set("text-anchor", "end"));
            for (k, [survived, tried]) in row.iter().enumerate() {
                let x = LEFT + CELL * k as f64;
                let share = f64::from(*survived) / f64::from((*tried).max(1));
                let ink = if share > 0.6 { "#ffffff" } else { "#33373d" };
                let cell = Rectangle::new()
                    .set("x", x)
                    .set("y", y)
                    .set("width", CELL - 2.0)
                    .set("height", ROW - 2.0)
                    .set("fill", colour(share));
                let count = format!("{survived}/{tried}");
                let count = text(&count, x + 0.5 * CELL - 1.0, y + 17.0)
                    .set("text-anchor", "middle")
                    .set("fill", ink);
                out = out.add(cell).add(count);
            }
        }
        format!("{out}\n")
    }

    /// Heads and rows of the map as a table.
    pub fn table(&self) -> (Vec<String>, Vec<Vec<String>>) {
        let [rows, columns] = &self.axes;
        let mut head = vec![format!("{rows} \\ {columns}")];
        head.extend(self.columns.iter().cloned());
        let cell = |[a, b]: &[u32; 2]| format!("{a}/{b}");
        let mut out: Vec<Vec<String>> = self
            .rows
            .iter()
            .zip(&self.cells)
            .map(|(name, cells)| {
                let mut row = vec![name.clone()];
                row.extend(cells.iter().map(cell));
                row
            })
            .collect();
        let mut all = vec!["all".to_owned()];
        all.extend((0..self.columns.len()).map(|k| cell(&self.column(k))));
        out.push(all);
        (head, out)
    }
}

/// From paper to blue.
fn colour(share: f64) -> String {
    let mix = |a: f64, b: f64| (a + (b - a) * share.clamp(0.0, 1.0)).round();
    format!(
        "rgb({},{},{})",
        mix(236.0, 0.0),
        mix(228.0, 104.0),
        mix(216.0, 170.0)
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map() -> SurvivalMap {
        SurvivalMap {
            title: "Pushes <all>".into(),
            axes: ["from".into(), "N·s".into()],
            rows: vec!["front".into(), "left".into()],
            columns: vec!["10".into(), "20".into(), "30".into()],
            cells: vec![vec![[8, 8], [4, 8], [0, 8]], vec![[8, 8], [8, 8], [1, 8]]],
        }
    }

    #[test]
    fn sums_are_of_all_cells() {
        assert_eq!(map().total(), [29, 48]);
        assert_eq!(map().column(1), [12, 16]);
        let (head, rows) = map().table();
        assert_eq!(head, ["from \\ N·s", "10", "20", "30"]);
        assert_eq!(rows[2], ["all", "16/16", "12/16", "1/16"]);
    }

    #[test]
    fn the_drawing_has_a_cell_for_each_number_and_escapes_text() {
        let svg = map().svg();
        assert_eq!(svg.matches("<rect").count(), 1 + 6);
        assert!(svg.contains("Pushes &lt;all&gt;") && svg.contains("\n4/8\n"));
        assert_eq!(svg.matches("<text").count(), svg.matches("</text>").count());
    }
}
