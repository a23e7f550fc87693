//! Leases of figures.

use super::super::pb;
use super::super::status::Fault;
use super::super::types::{ControlInfo, ControlKey};
use super::names::FIGURE;
use super::{or_default, timestamp, within};
use crate::types::MAX_DRIVEN_FIGURES;
use std::sync::Arc;
use std::time::{Duration, SystemTime};

/// Most bytes of a token.
const MOST_TOKEN: usize = 128;
/// Time for which an unused lease is kept if the request does not say, ms.
const GRACE_MS: f64 = 10_000.0;

fn token(field: &str, token: &str) -> Result<(), Fault> {
    // Errors do not repeat the input, because it may be a secret of another service.
    if token.len() > MOST_TOKEN {
        return Err(Fault::invalid(
            field,
            format!("must be at most {MOST_TOKEN} bytes"),
        ));
    }
    Ok(())
}

/// The principal and its tokens.
pub fn key(principal: &Arc<str>, field: &str, tokens: &[String]) -> Result<ControlKey, Fault> {
    if tokens.len() > MAX_DRIVEN_FIGURES {
        return Err(Fault::invalid(
            field,
            format!(
                "must be at most {MAX_DRIVEN_FIGURES} tokens, got {}",
                tokens.len()
            ),
        ));
    }
    for (i, t) in tokens.iter().enumerate() {
        token(&format!("{field}[{i}]"), t)?;
    }
    Ok(ControlKey {
        principal: principal.clone(),
        tokens: tokens.to_vec(),
    })
}

/// The principal and its token, if there is one.
pub fn single(principal: &Arc<str>, field: &str, text: &str) -> Result<ControlKey, Fault> {
    token(field, text)?;
    let tokens = (!text.is_empty()).then(|| text.to_owned());
    Ok(ControlKey {
        principal: principal.clone(),
        tokens: tokens.into_iter().collect(),
    })
}

/// Time for which an unused lease is kept.
pub fn grace(field: &str, ms: f64) -> Result<Duration, Fault> {
    or_default(field, ms, GRACE_MS, 1.0, 60_000.0).map(|ms| Duration::from_secs_f64(ms / 1e3))
}

/// Priority of a lease.
pub fn priority(field: &str, value: i32, most: i32) -> Result<i32, Fault> {
    within(field, f64::from(value), 0.0, f64::from(most)).map(|_| value)
}

/// Time over which a figure changes to the new motion, s, and time for which the offer stands.
pub fn offer(blend_ms: f64, offer_ms: f64) -> Result<(f64, Duration), Fault> {
    let blend = or_default("blend_ms", blend_ms, 500.0, 0.0, 5000.0)? / 1e3;
    let lasts = or_default("offer_ms", offer_ms, 30_000.0, 1.0, 600_000.0)?;
    Ok((blend, Duration::from_secs_f64(lasts / 1e3)))
}

/// A lease for a response.
pub fn lease(world: &str, c: &ControlInfo) -> pb::ControlLease {
    let text = |t: &Option<Arc<str>>| t.as_deref().unwrap_or_default().to_owned();
    pb::ControlLease {
        figure: FIGURE.name([world, &c.figure]),
        holder: text(&c.holder),
        control_epoch: c.epoch,
        priority: c.priority,
        expire_time: c.expires_in.map(|left| timestamp(SystemTime::now() + left)),
        implicit: c.implicit,
        offered_to: text(&c.offered_to),
    }
}
