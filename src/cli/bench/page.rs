//! The page of metrics of a server.

use crate::remote::explain;
use anyhow::Context as _;
use sinew_client::Client;
use std::collections::BTreeMap;

/// A page of metrics at one instant.
pub(super) struct MetricsPage(BTreeMap<String, f64>);

impl MetricsPage {
    /// The page of a server.
    pub(super) async fn read(client: &Client) -> anyhow::Result<Self> {
        let text = client.page("/metrics").await.map_err(|e| explain(&e))?;
        let page = Self::parse(&text);
        page.0
            .get("sinew_ticks_total")
            .context("the page /metrics of the server has no sinew_ticks_total")?;
        Ok(page)
    }

    fn parse(text: &str) -> Self {
        let lines = text.lines().filter(|l| !l.starts_with('#'));
        let samples = lines.filter_map(|l| {
            let (name, value) = l.rsplit_once(' ')?;
            Some((name.to_owned(), value.parse().ok()?))
        });
        Self(samples.collect())
    }

    /// A sample; 0 if it is not there.
    pub(super) fn get(&self, name: &str) -> f64 {
        self.0.get(name).copied().unwrap_or(0.0)
    }

    /// How much a sample grew since `before`.
    pub(super) fn growth(&self, before: &Self, name: &str) -> f64 {
        self.get(name) - before.get(name)
    }

    /// Buckets of a histogram without labels, counted since `before`: upper bound, and number of values at or below it.
    pub(super) fn buckets(&self, before: &Self, name: &str) -> Vec<(f64, f64)> {
        let start = format!("{name}_bucket{{le=\"");
        let mut buckets: Vec<(f64, f64)> = self
            .0
            .iter()
            .filter_map(|(sample, count)| {
                let bound = sample.strip_prefix(&start)?.strip_suffix("\"}")?;
                Some((bound.parse().ok()?, count - before.get(sample)))
            })
            .collect();
        buckets.sort_by(|a, b| a.0.total_cmp(&b.0));
        buckets
    }
}

/// The value below which a share `q` of the values in the buckets lies: linear within a bucket, as in Prometheus; the
/// largest finite bound for values beyond that. `None` for empty buckets.
pub(super) fn quantile(buckets: &[(f64, f64)], q: f64) -> Option<f64> {
    let total = buckets.last()?.1;
    if total <= 0.0 {
        return None;
    }
    let rank = q * total;
    let i = buckets.iter().position(|(_, n)| *n >= rank)?;
    let (low, below) = i.checked_sub(1).map_or((0.0, 0.0), |i| buckets[i]);
    let (high, within) = buckets[i];
    if high.is_infinite() {
        return Some(low);
    }
    let part = if within > below {
        (rank - below) / (within - below)
    } else {
        1.0
    };
    Some(low + part * (high - low))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_of_what_was_counted_between_two_pages() {
        let page = |a: u32, b: u32, c: u32| {
            MetricsPage::parse(&format!(
                "# TYPE t histogram\nt_bucket{{le=\"0.001\"}} {a}\nt_bucket{{le=\"0.01\"}} {b}\n\
                 t_bucket{{le=\"+Inf\"}} {c}\nt_sum 3\nt_count {c}\n"
            ))
        };
        let (before, after) = (page(100, 100, 100), page(190, 199, 200));
        let buckets = after.buckets(&before, "t");
        assert_eq!(
            buckets.iter().map(|b| b.1).collect::<Vec<_>>(),
            [90.0, 99.0, 100.0]
        );
        let at = |q| quantile(&buckets, q).unwrap();
        assert!((at(0.45) - 0.0005).abs() < 1e-12);
        assert!((at(0.95) - 0.006).abs() < 1e-12, "{}", at(0.95));
        assert_eq!(at(0.999), 0.01, "it lies beyond");
        assert_eq!(quantile(&before.buckets(&before, "t"), 0.5), None);
        assert_eq!(after.growth(&before, "t_count"), 100.0);
    }
}
