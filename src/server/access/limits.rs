//! Limits on the calls of one client per second.

use crate::shares::ClientKey;
use sinew_wire::status::Fault;
use std::collections::HashMap;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Clients that are remembered. Those whose bucket is full again are forgotten first.
const REMEMBERED: usize = 8192;

/// A token bucket: `rate` per second in the long run, and `burst` at once.
#[derive(Clone, Copy, Debug)]
pub struct Bucket {
    tokens: f64,
    last: Instant,
}

impl Bucket {
    /// A full one.
    pub fn full(burst: f64, now: Instant) -> Self {
        Self {
            tokens: burst,
            last: now,
        }
    }

    /// Takes `cost` tokens.
    ///
    /// # Errors
    /// There are too few; then the time after which there are enough.
    pub fn take(&mut self, cost: f64, rate: f64, burst: f64, now: Instant) -> Result<(), Duration> {
        let passed = now.saturating_duration_since(self.last).as_secs_f64();
        self.last = now;
        self.tokens = (self.tokens + passed * rate).min(burst);
        // More than the bucket holds would never be admitted.
        let cost = cost.min(burst);
        if self.tokens < cost {
            return Err(Duration::from_secs_f64((cost - self.tokens) / rate));
        }
        self.tokens -= cost;
        Ok(())
    }

    fn is_full(&self, rate: f64, burst: f64, now: Instant) -> bool {
        self.tokens + now.saturating_duration_since(self.last).as_secs_f64() * rate >= burst
    }
}

/// The calls of all clients.
#[derive(Debug)]
pub struct CallRates {
    /// Calls per second, and at once; 0: any.
    rate: f64,
    buckets: Mutex<HashMap<ClientKey, Bucket>>,
}

impl CallRates {
    /// `rate` calls per second for each client; 0: no bound.
    pub fn new(rate: f64) -> Self {
        Self {
            rate,
            buckets: Mutex::default(),
        }
    }

    /// Counts a call.
    ///
    /// # Errors
    /// The client makes too many.
    pub fn admit(&self, client: &ClientKey, now: Instant) -> Result<(), Fault> {
        if self.rate == 0.0 {
            return Ok(());
        }
        let burst = self.rate.max(1.0);
        let mut buckets = self.buckets.lock().unwrap_or_else(PoisonError::into_inner);
        if buckets.len() >= REMEMBERED && !buckets.contains_key(client) {
            buckets.retain(|_, b| !b.is_full(self.rate, burst, now));
            if buckets.len() >= REMEMBERED {
                buckets.clear(); // too many busy clients at a time: the other limits still hold
            }
        }
        let bucket = buckets
            .entry(client.clone())
            .or_insert_with(|| Bucket::full(burst, now));
        let retry = bucket.take(1.0, self.rate, burst, now);
        drop(buckets);
        retry.map_err(|retry| Fault::Exhausted {
            limit: "max_client_calls_per_s",
            value: self.rate as u64,
            message: "calls of one client".into(),
            retry: Some(retry),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_client_that_calls_too_often_waits_and_others_do_not() {
        let rates = CallRates::new(10.0);
        let (a, b): (ClientKey, ClientKey) = ("a".into(), "b".into());
        let start = Instant::now();
        assert!((0..10).all(|_| rates.admit(&a, start).is_ok()));
        let Err(Fault::Exhausted {
            retry: Some(retry), ..
        }) = rates.admit(&a, start)
        else {
            panic!("admitted");
        };
        assert!(rates.admit(&b, start).is_ok());
        assert!(rates.admit(&a, start + retry / 2).is_err());
        assert!(
            rates
                .admit(&a, start + retry + Duration::from_micros(1))
                .is_ok()
        );
        // Memory is bounded, however many clients come.
        for i in 0..3 * REMEMBERED {
            let _ = rates.admit(&format!("{i}").into(), start);
        }
        assert!(rates.buckets.lock().unwrap().len() <= REMEMBERED);
    }
}
