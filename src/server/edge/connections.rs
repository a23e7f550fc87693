//! Incoming connections: their limits, and the choice of those to close when there are too many.
//!
//! A connection must bring its first request soon. The number of connections is limited, in total and per address. One
//! more takes the place of the one that has been without a request the longest. If all are in use, some more are
//! accepted anyway, for health and metrics only; of these, one that has its answer is closed first, then the oldest. So
//! a client that holds connections without using them locks out no other. Neither does a client that opens many at
//! once: a new connection keeps its place until its first request can have been read, and accepting waits for that if
//! necessary.

use super::super::access::tls::Tls;
use super::super::config::Config;
use futures_util::task::AtomicWaker;
use rustls::pki_types::CertificateDer;
use std::collections::BTreeMap;
use std::io;
use std::net::{IpAddr, SocketAddr};
use std::pin::Pin;
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, OnceLock, PoisonError, Weak};
use std::task::{Context, Poll, ready};
use std::time::Duration;
use tokio::io::{AsyncRead, AsyncWrite, ReadBuf};
use tokio::net::{TcpListener, TcpStream};
use tokio::time::{Instant, Sleep};
use tokio_rustls::server::TlsStream;
use tokio_stream::Stream;
use tonic::transport::server::Connected;

/// Connections beyond the limits, for health and metrics.
const RESERVED: usize = 256;
/// Time that a new connection has for its first request before another one can take its place. A client sends it at
/// once, but the connection has to be read as well. Longer would let a rush fill the queue of the kernel: beyond all
/// limits, [`RESERVED`] connections are accepted in this time.
const FIRST_WORD: Duration = Duration::from_millis(25);
/// Least time between two lines of the log about connections that were closed.
const LOG_EVERY: Duration = Duration::from_secs(10);
/// Part of their greatest age by which connections are asked to close sooner or later, so that connections that were
/// opened together do not reconnect together.
pub(crate) const AGE_SPREAD: f64 = 0.1;
/// Pause after a connection could not be accepted, for example for want of file handles.
const ACCEPT_PAUSE: Duration = Duration::from_millis(20);

/// Reason why the server closed a connection, or why it ended by itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Why {
    /// No request came in time.
    Silent,
    /// It made room for another one.
    Room,
    /// Its client did not read.
    Unread,
    /// The other side reset it.
    Reset,
    /// The TLS handshake failed.
    Tls,
    /// It was asked to close because of its age, and did not.
    Age,
}

impl Why {
    /// Its name in metrics and logs.
    fn name(self) -> &'static str {
        match self {
            Self::Silent => "silent",
            Self::Room => "room",
            Self::Unread => "unread",
            Self::Reset => "reset",
            Self::Tls => "tls",
            Self::Age => "age",
        }
    }
}

/// One connection, as the rest of the server sees it.
#[derive(Debug)]
pub(crate) struct Peer {
    /// The address of the client.
    pub address: SocketAddr,
    /// Whether it is beyond the limits.
    pub reserved: bool,
    /// When it came.
    since: Instant,
    /// Requests that are worked on.
    requests: AtomicUsize,
    /// Whether there was a request.
    begun: AtomicBool,
    /// Order in which connections were last used: the count of uses of all connections.
    used: AtomicU64,
    uses: Arc<AtomicU64>,
    closed: AtomicBool,
    reader: AtomicWaker,
    /// The client's certificate, once TLS is there; verified.
    certificate: OnceLock<CertificateDer<'static>>,
    doors: Weak<Doors>,
}

/// A request that is worked on; dropped at the end of its response.
#[derive(Debug)]
pub(super) struct Open(Arc<Peer>);

impl Open {
    /// Closes the connection.
    pub(super) fn close(&self, why: Why) {
        self.0.close(why);
    }
}

impl Drop for Open {
    fn drop(&mut self) {
        self.0.touch();
        self.0.requests.fetch_sub(1, Ordering::Relaxed);
    }
}

impl Peer {
    fn new(address: SocketAddr, reserved: bool, doors: &Arc<Doors>) -> Arc<Self> {
        let peer = Arc::new(Self {
            address,
            reserved,
            since: Instant::now(),
            requests: AtomicUsize::new(0),
            begun: AtomicBool::new(false),
            used: AtomicU64::new(0),
            uses: doors.uses.clone(),
            closed: AtomicBool::new(false),
            reader: AtomicWaker::new(),
            certificate: OnceLock::new(),
            doors: Arc::downgrade(doors),
        });
        peer.touch();
        peer
    }

    /// A peer that belongs to no server.
    #[cfg(test)]
    pub(super) fn alone() -> Arc<Self> {
        Self::new(
            ([127, 0, 0, 1], 1).into(),
            false,
            &Doors::new(&Config::default()),
        )
    }

    /// Begins a request.
    pub(super) fn open(self: &Arc<Self>) -> Open {
        self.requests.fetch_add(1, Ordering::Relaxed);
        self.begun.store(true, Ordering::Relaxed);
        self.touch();
        Open(self.clone())
    }

    /// The certificate that the client has shown and that was verified.
    pub(crate) fn certificate(&self) -> Option<&CertificateDer<'static>> {
        self.certificate.get()
    }

    fn touch(&self) {
        let now = self.uses.fetch_add(1, Ordering::Relaxed);
        self.used.store(now, Ordering::Relaxed);
    }

    /// Requests that are worked on, streams included.
    pub(super) fn open_requests(&self) -> u64 {
        self.requests.load(Ordering::Relaxed) as u64
    }

    fn is_idle(&self) -> bool {
        self.requests.load(Ordering::Relaxed) == 0
    }

    /// Time that it still has for its first request; zero once that was there.
    fn time_left(&self, patience: Duration) -> Duration {
        if self.begun.load(Ordering::Relaxed) {
            Duration::ZERO
        } else {
            patience.saturating_sub(self.since.elapsed())
        }
    }

    pub(super) fn is_closed(&self) -> bool {
        self.closed.load(Ordering::Acquire)
    }

    /// Closes the connection; only the first call counts.
    fn close(&self, why: Why) {
        if self.closed.swap(true, Ordering::AcqRel) {
            return;
        }
        self.reader.wake();
        if let Some(doors) = self.doors.upgrade() {
            doors.count(why);
        }
    }
}

/// The connections that are open.
#[derive(Debug)]
pub(crate) struct Doors {
    most: usize,
    most_per_address: usize,
    first_request: Duration,
    /// [`FIRST_WORD`].
    patience: Duration,
    /// When a connection is closed in any case.
    oldest: Option<Duration>,
    uses: Arc<AtomicU64>,
    open: Mutex<ConnectionTable>,
    log: Mutex<ClosedLog>,
}

#[derive(Debug, Default)]
struct ConnectionTable {
    next: u64,
    peers: BTreeMap<u64, Arc<Peer>>,
    /// Connections of each address, without those beyond the limits.
    by_address: BTreeMap<IpAddr, usize>,
    reserved: usize,
}

/// Closed connections that have not been logged yet.
#[derive(Debug, Default)]
struct ClosedLog {
    told: Option<Instant>,
    untold: BTreeMap<&'static str, u64>,
}

impl ConnectionTable {
    /// The least recently used one of `those`; connections without any request come first.
    fn last(&self, those: impl Fn(&Peer) -> bool) -> Option<u64> {
        let those = self.peers.iter().filter(|(_, p)| those(p));
        those
            .min_by_key(|(_, p)| {
                (
                    p.begun.load(Ordering::Relaxed),
                    p.used.load(Ordering::Relaxed),
                )
            })
            .map(|(number, _)| *number)
    }

    /// The best one to close beyond the limits. Such a connection needs only one answer, so one that has it no longer
    /// needs its place. A rush of others does not push out a connection that has yet to make its request.
    fn last_reserved(&self) -> Option<u64> {
        let reserved = self.peers.iter().filter(|(_, p)| p.reserved);
        let last = reserved.min_by_key(|(number, p)| {
            let answered = p.begun.load(Ordering::Relaxed) && p.is_idle();
            (!answered, **number)
        });
        last.map(|(number, _)| *number)
    }

    fn remove(&mut self, number: u64) -> Option<Arc<Peer>> {
        let peer = self.peers.remove(&number)?;
        if peer.reserved {
            self.reserved -= 1;
        } else if let Some(count) = self.by_address.get_mut(&peer.address.ip()) {
            *count -= 1;
            if *count == 0 {
                self.by_address.remove(&peer.address.ip());
            }
        }
        Some(peer)
    }
}

impl Doors {
    pub(super) fn new(config: &Config) -> Arc<Self> {
        Arc::new(Self::with_patience(config, FIRST_WORD))
    }

    fn with_patience(config: &Config, patience: Duration) -> Self {
        Self {
            most: config.max_connections as usize,
            most_per_address: config
                .max_connections_per_address
                .min(config.max_connections) as usize,
            first_request: Duration::from_secs_f64(config.first_request_s),
            oldest: (config.max_connection_age_s > 0.0).then(|| {
                let asked = config.max_connection_age_s * (1.0 + AGE_SPREAD);
                Duration::from_secs_f64(asked + config.connection_age_grace_s)
            }),
            patience,
            uses: Arc::default(),
            open: Mutex::default(),
            log: Mutex::default(),
        }
    }

    /// Most connections, without those for health and metrics.
    pub(super) fn most(&self) -> u64 {
        self.most as u64
    }

    fn table(&self) -> std::sync::MutexGuard<'_, ConnectionTable> {
        self.open.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Accepts one more connection, in place of another one if necessary. The error is the time to wait before it can
    /// be accepted, because all candidates for closing are new.
    fn enter(self: &Arc<Self>, address: SocketAddr) -> Result<(u64, Arc<Peer>), Duration> {
        let mut table = self.table();
        let left = |p: &Peer| p.time_left(self.patience);
        let can_go = |p: &Peer| !p.reserved && p.is_idle() && left(p).is_zero();
        let of_address = table.by_address.get(&address.ip()).copied().unwrap_or(0);
        let (full, last) = if of_address >= self.most_per_address {
            let own = |p: &Peer| can_go(p) && p.address.ip() == address.ip();
            (true, table.last(own))
        } else if table.peers.len() - table.reserved >= self.most {
            (true, table.last(can_go))
        } else {
            (false, None)
        };
        let reserved = full && last.is_none();
        let last = if reserved && table.reserved >= RESERVED {
            table.last_reserved()
        } else {
            last
        };
        let wait = last.and_then(|n| table.peers.get(&n)).map(|p| left(p));
        if let Some(wait) = wait.filter(|w| !w.is_zero()) {
            return Err(wait);
        }
        let gone = last.and_then(|n| table.remove(n));
        let peer = Peer::new(address, reserved, self);
        let number = table.next;
        table.next += 1;
        table.peers.insert(number, peer.clone());
        if reserved {
            table.reserved += 1;
        } else {
            *table.by_address.entry(address.ip()).or_default() += 1;
        }
        metrics::gauge!("sinew_connections").set(table.peers.len() as f64);
        drop(table);
        if let Some(peer) = gone {
            peer.close(Why::Room);
        }
        Ok((number, peer))
    }

    /// [`Self::enter`], once there is room.
    async fn wait_to_enter(self: &Arc<Self>, address: SocketAddr) -> (u64, Arc<Peer>) {
        loop {
            match self.enter(address) {
                Ok(entered) => return entered,
                Err(wait) => tokio::time::sleep(wait).await,
            }
        }
    }

    fn leave(&self, number: u64) {
        let mut table = self.table();
        table.remove(number);
        metrics::gauge!("sinew_connections").set(table.peers.len() as f64);
    }

    /// Counts a connection that its client did not end normally, and logs the counts occasionally.
    fn count(&self, why: Why) {
        metrics::counter!("sinew_connections_closed_total", "reason" => why.name()).increment(1);
        let mut log = self.log.lock().unwrap_or_else(PoisonError::into_inner);
        *log.untold.entry(why.name()).or_default() += 1;
        let now = Instant::now();
        if log.told.is_none_or(|told| now - told >= LOG_EVERY) {
            log.told = Some(now);
            let counts: Vec<String> = log
                .untold
                .iter()
                .map(|(name, n)| format!("{name} {n}"))
                .collect();
            log.untold.clear();
            drop(log);
            tracing::warn!(
                "connections closed since the last such line: {}",
                counts.join(", ")
            );
        }
    }
}

/// The transport of a connection.
enum Transport {
    Plain(TcpStream),
    /// The TLS handshake is in progress. Reads and writes drive it, so that accepting never waits for a client.
    Agreeing(Box<tokio_rustls::Accept<TcpStream>>),
    Tls(Box<TlsStream<TcpStream>>),
    /// It was not agreed on.
    Refused,
}

/// A connection that leaves when it is dropped.
pub(crate) struct Connection {
    transport: Transport,
    peer: Arc<Peer>,
    number: u64,
    doors: Arc<Doors>,
    /// Deadline of the first request; `None` once it has arrived.
    deadline: Option<Pin<Box<Sleep>>>,
    /// Time at which it is closed because of its age.
    end: Option<Pin<Box<Sleep>>>,
}

/// Connections as they come.
pub(crate) fn incoming(
    listener: TcpListener,
    doors: Arc<Doors>,
    tls: Option<Tls>,
) -> impl Stream<Item = io::Result<Connection>> {
    let state = (listener, doors, tls);
    futures_util::stream::unfold(state, |(listener, doors, tls)| async move {
        loop {
            match listener.accept().await {
                Ok((stream, address)) => {
                    // Frames are small and wanted at once.
                    let _ = stream.set_nodelay(true);
                    metrics::counter!("sinew_connections_total").increment(1);
                    let (number, peer) = doors.wait_to_enter(address).await;
                    let transport = match &tls {
                        Some(tls) => Transport::Agreeing(Box::new(tls.acceptor().accept(stream))),
                        None => Transport::Plain(stream),
                    };
                    let connection = Connection {
                        transport,
                        peer,
                        number,
                        deadline: Some(Box::pin(tokio::time::sleep(doors.first_request))),
                        end: doors.oldest.map(|age| Box::pin(tokio::time::sleep(age))),
                        doors: doors.clone(),
                    };
                    return Some((Ok(connection), (listener, doors, tls)));
                }
                Err(error) if is_of_the_client(&error) => doors.count(Why::Reset),
                Err(error) => {
                    // A temporary lack of file handles must not end the server.
                    tracing::warn!(%error, "accept failed");
                    tokio::time::sleep(ACCEPT_PAUSE).await;
                }
            }
        }
    })
}

/// Whether a connection broke because the other side left.
fn is_of_the_client(error: &io::Error) -> bool {
    use io::ErrorKind::{BrokenPipe, ConnectionAborted, ConnectionReset};
    matches!(
        error.kind(),
        BrokenPipe | ConnectionAborted | ConnectionReset
    )
}

impl Connected for Connection {
    type ConnectInfo = Arc<Peer>;
    fn connect_info(&self) -> Arc<Peer> {
        self.peer.clone()
    }
}

impl Drop for Connection {
    fn drop(&mut self) {
        self.doors.leave(self.number);
    }
}

impl Connection {
    /// Completes the TLS handshake, if still necessary.
    fn poll_agreed(&mut self, cx: &mut Context<'_>) -> Poll<io::Result<()>> {
        let Transport::Agreeing(accept) = &mut self.transport else {
            return Poll::Ready(match self.transport {
                Transport::Refused => Err(io::ErrorKind::ConnectionAborted.into()),
                _ => Ok(()),
            });
        };
        match ready!(Pin::new(&mut **accept).poll(cx)) {
            Ok(stream) => {
                let certificates = stream.get_ref().1.peer_certificates();
                if let Some(first) = certificates.and_then(<[_]>::first) {
                    // It is set once: here.
                    let _ = self.peer.certificate.set(first.clone().into_owned());
                }
                self.transport = Transport::Tls(Box::new(stream));
                Poll::Ready(Ok(()))
            }
            Err(error) => {
                self.transport = Transport::Refused;
                self.peer.close(Why::Tls);
                tracing::debug!(%error, "no TLS");
                Poll::Ready(Err(error))
            }
        }
    }

    /// Whether the connection is to end now.
    fn is_over(&mut self, cx: &mut Context<'_>) -> bool {
        if self.peer.begun.load(Ordering::Relaxed) {
            self.deadline = None;
        }
        if self
            .deadline
            .as_mut()
            .is_some_and(|d| d.as_mut().poll(cx).is_ready())
        {
            self.deadline = None;
            self.peer.close(Why::Silent);
        }
        let end = self.end.as_mut();
        if end.is_some_and(|e| e.as_mut().poll(cx).is_ready()) {
            self.end = None;
            self.peer.close(Why::Age);
        }
        self.peer.reader.register(cx.waker());
        self.peer.is_closed()
    }
}

impl AsyncRead for Connection {
    fn poll_read(
        mut self: Pin<&mut Self>,
        cx: &mut Context<'_>,
        buf: &mut ReadBuf<'_>,
    ) -> Poll<io::Result<()>> {
        if self.is_over(cx) {
            return Poll::Ready(Err(io::ErrorKind::TimedOut.into()));
        }
        ready!(self.poll_agreed(cx))?;
        let read = match &mut self.transport {
            Transport::Plain(stream) => Pin::new(stream).poll_read(cx, buf),
            Transport::Tls(stream) => Pin::new(&mut **stream).poll_read(cx, buf),
            Transport::Agreeing(_) | Transport::Refused => return Poll::Pending, // not after `poll_agreed`
        };
        if let Poll::Ready(Err(error)) = &read
            && is_of_the_client(error)
            && !self.peer.closed.swap(true, Ordering::AcqRel)
        {
            self.doors.count(Why::Reset);
        }
        read
    }
}

/// Calls a method of the stream that is written to, once TLS is established.
macro_rules! write_to {
    ($self:ident, $cx:ident, $method:ident($($argument:expr),*)) => {{
        ready!($self.poll_agreed($cx))?;
        match &mut $self.transport {
            Transport::Plain(stream) => Pin::new(stream).$method($cx $(, $argument)*),
            Transport::Tls(stream) => Pin::new(&mut **stream).$method($cx $(, $argument)*),
            Transport::Agreeing(_) | Transport::Refused => {
                Poll::Ready(Err(io::ErrorKind::ConnectionAborted.into()))
            }
        }
    }};
}

impl AsyncWrite for Connection {
    fn poll_write(
        mut self: Pin<&mut Self>,
        cx: &mut Context<'_>,
        buf: &[u8],
    ) -> Poll<io::Result<usize>> {
        write_to!(self, cx, poll_write(buf))
    }
    fn poll_flush(mut self: Pin<&mut Self>, cx: &mut Context<'_>) -> Poll<io::Result<()>> {
        write_to!(self, cx, poll_flush())
    }
    fn poll_shutdown(mut self: Pin<&mut Self>, cx: &mut Context<'_>) -> Poll<io::Result<()>> {
        if matches!(self.transport, Transport::Agreeing(_)) {
            self.transport = Transport::Refused; // no task waits for TLS any more
        }
        write_to!(self, cx, poll_shutdown())
    }
    fn poll_write_vectored(
        mut self: Pin<&mut Self>,
        cx: &mut Context<'_>,
        bufs: &[io::IoSlice<'_>],
    ) -> Poll<io::Result<usize>> {
        write_to!(self, cx, poll_write_vectored(bufs))
    }
    fn is_write_vectored(&self) -> bool {
        match &self.transport {
            Transport::Plain(stream) => stream.is_write_vectored(),
            Transport::Tls(stream) => stream.is_write_vectored(),
            Transport::Agreeing(_) | Transport::Refused => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn doors(most: u64, per_address: u64) -> Arc<Doors> {
        patient(most, per_address, Duration::ZERO)
    }

    fn patient(most: u64, per_address: u64, patience: Duration) -> Arc<Doors> {
        let config = Config {
            max_connections: most,
            max_connections_per_address: per_address,
            ..Config::default()
        };
        Arc::new(Doors::with_patience(&config, patience))
    }

    fn enter(doors: &Arc<Doors>, address: SocketAddr) -> Arc<Peer> {
        doors.enter(address).expect("there is room").1
    }

    fn from(last: u8) -> SocketAddr {
        ([10, 0, 0, last], 1000).into()
    }

    #[test]
    fn one_more_takes_the_place_of_the_one_that_is_unused_the_longest() {
        let doors = doors(3, 3);
        let first = enter(&doors, from(1));
        let silent = enter(&doors, from(2));
        let busy = enter(&doors, from(3));
        let _request = busy.open();
        drop(first.open()); // used, and after the silent one
        let fourth = enter(&doors, from(4));
        assert!(silent.is_closed() && !first.is_closed() && !busy.is_closed());
        drop(fourth.open());
        enter(&doors, from(5));
        assert!(first.is_closed() && !fourth.is_closed() && !busy.is_closed());
    }

    #[test]
    fn an_address_takes_no_more_than_its_share() {
        let doors = doors(10, 2);
        let other = enter(&doors, from(2));
        let own: Vec<_> = (0..3).map(|_| enter(&doors, from(1))).collect();
        assert_eq!(
            own.iter().map(|p| p.is_closed()).collect::<Vec<_>>(),
            [true, false, false]
        );
        assert!(!other.is_closed());
        let _busy = (own[1].open(), own[2].open());
        assert!(
            enter(&doors, from(1)).reserved,
            "all of its own are at work"
        );
        assert!(!enter(&doors, from(3)).reserved);
    }

    #[test]
    fn an_address_that_has_its_share_closes_nobody_else() {
        let doors = doors(2, 1);
        let other = enter(&doors, from(2));
        let busy = enter(&doors, from(1));
        let _request = busy.open();
        assert!(enter(&doors, from(1)).reserved);
        assert!(!other.is_closed(), "it would have made no room");
    }

    #[test]
    fn health_has_a_place_when_all_are_at_work() {
        let doors = doors(2, 2);
        let busy: Vec<_> = (0..2).map(|i| enter(&doors, from(i))).collect();
        let _requests: Vec<_> = busy.iter().map(Peer::open).collect();
        let extra: Vec<_> = (0..RESERVED + 1).map(|_| enter(&doors, from(9))).collect();
        assert!(extra.iter().all(|p| p.reserved));
        assert!(extra[0].is_closed(), "the oldest made room");
        assert!(extra[1..].iter().all(|p| !p.is_closed()) && busy.iter().all(|p| !p.is_closed()));
        // A connection that has its answer is closed before one that has yet to make its request, and before one that
        // is being answered.
        let asking = extra[2].open();
        drop(extra[3].open());
        enter(&doors, from(9));
        assert!(extra[3].is_closed() && !extra[1].is_closed() && !extra[2].is_closed());
        drop(asking);
        enter(&doors, from(9));
        assert!(extra[2].is_closed() && !extra[1].is_closed());
    }

    #[test]
    fn who_leaves_gives_the_place_back() {
        let doors = doors(1, 1);
        let (number, peer) = doors.enter(from(1)).unwrap();
        let _request = peer.open();
        doors.leave(number);
        doors.leave(number); // once is enough
        assert!(!enter(&doors, from(1)).reserved);
    }
    #[test]
    fn who_has_just_come_keeps_the_place_until_the_first_request() {
        let doors = patient(2, 2, Duration::from_secs(3600));
        let busy = enter(&doors, from(1));
        let _request = busy.open();
        let new = enter(&doors, from(2));
        let rush: Vec<_> = (0..RESERVED).map(|_| enter(&doors, from(3))).collect();
        assert!(rush.iter().all(|p| p.reserved && !p.is_closed()));
        assert!(!new.is_closed(), "it has not had the time to ask");
        let wait = doors.enter(from(3)).unwrap_err();
        assert!(wait > Duration::from_secs(3000));
        assert!(!new.is_closed() && rush.iter().all(|p| !p.is_closed()));
        // With its answer it can go, and the next one has the usual place.
        drop(new.open());
        assert!(!enter(&doors, from(3)).reserved && new.is_closed());
    }
}
