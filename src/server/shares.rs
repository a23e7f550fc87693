//! The share of one client in common resources.
//!
//! Without accounts a client is a connection or an address. On the server's own machine every program has the same
//! address, so there a client is a connection; elsewhere it is the address, however many connections come from it.

use sinew_wire::status::Fault;
use std::net::{IpAddr, SocketAddr};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// The client that makes a request. Everything of one client shares its part of workers, streams and worlds.
pub type ClientKey = Arc<str>;

/// The client behind a peer address.
pub fn client_at(peer: Option<SocketAddr>) -> ClientKey {
    match peer {
        None => "".into(),
        Some(at) if at.ip().to_canonical().is_loopback() => at.to_string().into(),
        Some(at) => match at.ip().to_canonical() {
            IpAddr::V4(ip) => ip.to_string().into(),
            // The owner of one IPv6 address of a network has all of them.
            IpAddr::V6(ip) => {
                let [a, b, c, d, ..] = ip.segments();
                format!("{a:x}:{b:x}:{c:x}:{d:x}::/64").into()
            }
        },
    }
}

/// Whether a client can come back under the same name after a restart of the server. A client that is a connection
/// cannot.
pub fn comes_back(client: &str) -> bool {
    client.parse::<SocketAddr>().is_err()
}

/// How many of `most` one client may have.
pub fn part(most: u64, share: f64) -> u64 {
    ((most as f64 * share).ceil() as u64).max(1)
}

/// Refuses one more if a client has its part already.
///
/// `own`, the client's use of `limit`, has reached its part.
/// `own` is what the client uses of `limit` already, with one more.
pub fn check_part(limit: &'static str, own: u64, most: u64, share: f64) -> Result<(), Fault> {
    let part = part(most, share);
    if own < part {
        return Ok(());
    }
    Err(Fault::Exhausted {
        limit,
        value: most,
        message: format!("one client may have {part} of them (max_client_share)"),
        retry: None,
    })
}

/// Places for streams of one kind.
#[derive(Debug)]
pub struct Places {
    taken: Arc<Mutex<Vec<ClientKey>>>,
    limit: &'static str,
    most: u64,
    share: f64,
    gauge: &'static str,
}

/// A place that is freed when the stream ends.
#[derive(Debug)]
pub struct HeldPlace {
    taken: Arc<Mutex<Vec<ClientKey>>>,
    client: ClientKey,
    gauge: &'static str,
}

fn locked(taken: &Mutex<Vec<ClientKey>>) -> MutexGuard<'_, Vec<ClientKey>> {
    // Entries are whole.
    taken.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Drop for HeldPlace {
    fn drop(&mut self) {
        let mut taken = locked(&self.taken);
        if let Some(i) = taken.iter().position(|c| *c == self.client) {
            taken.swap_remove(i);
        }
        metrics::gauge!(self.gauge).decrement(1.0);
    }
}

impl Places {
    /// `most` places, as the setting `limit` says, of which one client may have a `share`; `gauge` is their metric.
    pub fn new(limit: &'static str, most: u64, share: f64, gauge: &'static str) -> Self {
        Self {
            taken: Arc::default(),
            limit,
            most,
            share,
            gauge,
        }
    }

    /// Takes a place.
    ///
    /// # Errors
    /// All are taken, or the client already has its part.
    pub fn take(&self, client: ClientKey) -> Result<HeldPlace, Fault> {
        let mut taken = locked(&self.taken);
        if taken.len() as u64 >= self.most {
            return Err(Fault::Exhausted {
                limit: self.limit,
                value: self.most,
                message: "one more stream".into(),
                retry: Some(Duration::from_secs(1)),
            });
        }
        let own = taken.iter().filter(|c| **c == client).count() as u64;
        check_part(self.limit, own, self.most, self.share)?;
        taken.push(client.clone());
        metrics::gauge!(self.gauge).increment(1.0);
        Ok(HeldPlace {
            taken: Arc::clone(&self.taken),
            client,
            gauge: self.gauge,
        })
    }

    /// Places that are taken.
    pub fn taken(&self) -> usize {
        locked(&self.taken).len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(text: &str) -> ClientKey {
        client_at(Some(text.parse().unwrap()))
    }

    #[test]
    fn a_client_is_a_connection_here_and_an_address_elsewhere() {
        assert_ne!(at("127.0.0.1:1"), at("127.0.0.1:2"));
        assert_ne!(at("[::1]:1"), at("[::1]:2"));
        assert_eq!(at("192.0.2.1:1"), at("192.0.2.1:2"));
        assert_eq!(at("192.0.2.1:1"), at("[::ffff:192.0.2.1]:2"));
        assert_ne!(at("192.0.2.1:1"), at("192.0.2.2:1"));
        assert_eq!(at("[2001:db8:1:2::1]:1"), at("[2001:db8:1:2:ffff::2]:9"));
        assert_ne!(at("[2001:db8:1:2::1]:1"), at("[2001:db8:1:3::1]:1"));
    }

    #[test]
    fn one_client_leaves_places_for_others_and_gives_its_own_back() {
        let places = Places::new("max_viewers", 5, 0.5, "test_places");
        let (a, b) = (at("127.0.0.1:1"), at("127.0.0.1:2"));
        let held: Vec<HeldPlace> = (0..3).map(|_| places.take(a.clone()).unwrap()).collect();
        let refused = places.take(a.clone()).unwrap_err();
        assert!(
            refused.to_string().contains("max_client_share"),
            "{refused}"
        );
        let others: Vec<HeldPlace> = (0..2).map(|_| places.take(b.clone()).unwrap()).collect();
        let full = places.take(b.clone()).unwrap_err();
        assert!(full.to_string().contains("one more stream"), "{full}");
        drop(held);
        assert_eq!(places.taken(), 2);
        places.take(a).unwrap();
        drop(others);
        assert_eq!(places.taken(), 0);
        assert_eq!((part(2, 0.5), part(1, 0.1), part(16, 1.0)), (1, 1, 16));
    }
}
