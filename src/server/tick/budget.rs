//! The cost of the ticks of all worlds, and its limit.
//!
//! Each world keeps an account of the processor time of its ticks. Anything that would bring a world or the machine
//! over the budget is refused beforehand: a new figure, a new world, a faster clock. Costs that grow later (a fall, a
//! crowd that touches) cannot be refused. Worlds that need more than an equal share then rest between their ticks, so
//! that all together stay within the budget.

use sinew_wire::status::Fault;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, Weak};
use std::time::Duration;

/// Processor time of a tick without figures, s. Measured: 5 to 15 µs.
const EMPTY_TICK: f64 = 10e-6;
/// Processor time of one figure in a tick and in each of its substeps, s, until it is measured: a standing figure takes
/// 90 µs with two substeps.
const FIGURE_TICK: f64 = 50e-6;
/// See [`FIGURE_TICK`].
const FIGURE_SUBSTEP: f64 = 20e-6;
/// Weight of the latest tick in the mean.
const RECENT: f64 = 1.0 / 32.0;
/// Least time between two checks of all accounts, as a multiple of a tick.
const LOOK: u32 = 16;

/// A number that one thread writes and others read.
#[derive(Debug, Default)]
struct Gauge(AtomicU64);

impl Gauge {
    fn get(&self) -> f64 {
        f64::from_bits(self.0.load(Ordering::Relaxed))
    }
    fn set(&self, value: f64) {
        self.0.store(value.to_bits(), Ordering::Relaxed);
    }
    fn approach(&self, value: f64) {
        self.set(self.get() + RECENT * (value - self.get()));
    }
}

/// The account of one world.
#[derive(Debug, Default)]
pub struct Account {
    /// Processor time of a tick, s.
    cost: Gauge,
    /// Processor time of one figure in a tick, s.
    figure: Gauge,
    /// Ticks per second; 0 while the clock stands still.
    pace: Gauge,
}

impl Account {
    /// Processors that the world needs. More than 1 is more than it can have.
    pub fn need(&self) -> f64 {
        self.cost.get() * self.pace.get()
    }

    /// Notes a tick: its processor time and that of its physics, for this number of figures.
    pub fn record(&self, tick: Duration, physics: Duration, figures: usize) {
        self.cost.approach(tick.as_secs_f64());
        if figures > 0 {
            self.figure.approach(physics.as_secs_f64() / figures as f64);
        }
    }
}

/// The budget of the machine.
#[derive(Debug)]
pub struct Budget {
    processors: f64,
    share: f64,
    accounts: Mutex<Vec<Weak<Account>>>,
}

impl Budget {
    /// `share` of the processors of this machine, and of the period of each world.
    pub fn new(share: f64) -> Self {
        let processors = std::thread::available_parallelism().map_or(1, usize::from);
        Self {
            processors: processors as f64,
            share,
            accounts: Mutex::default(),
        }
    }

    fn accounts(&self) -> MutexGuard<'_, Vec<Weak<Account>>> {
        // Entries are whole.
        self.accounts.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Share of the processors that all running worlds need.
    pub fn used(&self) -> f64 {
        let all: Vec<_> = self.accounts().iter().filter_map(Weak::upgrade).collect();
        total(&all) / self.processors
    }

    /// Share of the processors that they may need.
    pub fn limit(&self) -> f64 {
        self.share
    }

    /// An account for a new world whose clock will run at `pace` ticks per second; 0: it stands still.
    ///
    /// # Errors
    /// There is no room in the budget.
    pub fn open(&self, pace: f64, substeps: u32) -> Result<Arc<Account>, Fault> {
        let account = Arc::new(Account::default());
        account
            .figure
            .set(FIGURE_TICK + FIGURE_SUBSTEP * f64::from(substeps));
        self.change(&account, EMPTY_TICK, pace)?;
        let mut accounts = self.accounts();
        accounts.retain(|a| a.strong_count() > 0);
        accounts.push(Arc::downgrade(&account));
        Ok(account)
    }

    /// Sets the pace of a world's clock, ticks per second.
    ///
    /// # Errors
    /// It would be faster and there is no room in the budget.
    pub fn set_pace(&self, account: &Account, pace: f64) -> Result<(), Fault> {
        self.change(account, account.cost.get(), pace)
    }

    /// Checks the change that [`Self::set_pace`] would make.
    ///
    /// # Errors
    /// It would be faster and there is no room in the budget.
    pub fn would_set_pace(&self, account: &Account, pace: f64) -> Result<(), Fault> {
        let accounts = self.accounts();
        self.admit(&accounts, account, account.cost.get() * pace)
    }

    /// Makes room for one more figure.
    ///
    /// # Errors
    /// There is no room in the budget.
    pub fn add_figure(&self, account: &Account) -> Result<(), Fault> {
        let cost = account.cost.get() + account.figure.get();
        self.change(account, cost, account.pace.get())
    }

    /// Removes one figure from an account; the remaining cost will be measured soon.
    pub fn remove_figure(&self, account: &Account) {
        let cost = account.cost.get() - account.figure.get();
        account.cost.set(cost.max(EMPTY_TICK));
    }

    /// Checks and books in one step, so that two worlds do not take the same room.
    fn change(&self, account: &Account, cost: f64, pace: f64) -> Result<(), Fault> {
        let accounts = self.accounts();
        self.admit(&accounts, account, cost * pace)?;
        account.cost.set(cost);
        account.pace.set(pace);
        Ok(())
    }

    /// Whether a world may need this amount.
    fn admit(&self, accounts: &[Weak<Account>], account: &Account, need: f64) -> Result<(), Fault> {
        let others: Vec<Arc<Account>> = accounts
            .iter()
            .filter_map(Weak::upgrade)
            .filter(|a| !std::ptr::eq(&**a, account))
            .collect();
        if need > account.need() {
            self.check("the world", need, 1.0)?;
            self.check("the machine", total(&others) + need, self.processors)?;
        }
        Ok(())
    }

    fn check(&self, whose: &'static str, need: f64, of: f64) -> Result<(), Fault> {
        if need <= self.share * of {
            return Ok(());
        }
        Err(Fault::Budget {
            whose,
            percent: 100.0 * need / of,
            limit: 100.0 * self.share,
        })
    }

    /// Largest share of a processor that a world may use at present. It is 1 unless all running worlds together need
    /// more than the budget and this one more than an equal part of it.
    pub fn allowance(&self, account: &Account) -> f64 {
        let Ok(accounts) = self.accounts.try_lock() else {
            return 1.0; // the world's thread must not wait; the next check will tell
        };
        let needs: Vec<f64> = accounts
            .iter()
            .filter_map(Weak::upgrade)
            .map(|a| a.need().min(1.0))
            .filter(|n| *n > 0.0)
            .collect();
        fair(&needs, self.share * self.processors, account.need())
    }
}

fn total(accounts: &[Arc<Account>]) -> f64 {
    // A world does not take away from others the budget that it cannot use.
    accounts.iter().map(|a| a.need().min(1.0)).sum()
}

/// Share of `capacity` for the world that needs `own`, one of `needs`, if each gets what it needs or an equal part of
/// the rest.
fn fair(needs: &[f64], capacity: f64, own: f64) -> f64 {
    if needs.len() < 2 || needs.iter().sum::<f64>() <= capacity {
        return 1.0;
    }
    let mut sorted = needs.to_vec();
    sorted.sort_by(f64::total_cmp);
    let mut left = capacity;
    for (i, need) in sorted.iter().enumerate() {
        let equal = left / (sorted.len() - i) as f64;
        if *need > equal {
            return if own > equal { equal.min(1.0) } else { 1.0 };
        }
        left -= need;
    }
    1.0
}

/// Meter of one world. Successive rounds may run on different threads.
pub struct Meter {
    account: Arc<Account>,
    budget: Arc<Budget>,
    /// Start of this round on the processor clock of its thread. Reading that clock is a system call, so it is read
    /// twice a round.
    begun: Duration,
    /// Processor time since the last tick.
    spent: Duration,
    allowance: f64,
    ticks: u32,
}

impl Meter {
    /// A meter of the world with that account.
    pub fn new(account: Arc<Account>, budget: Arc<Budget>) -> Self {
        Self {
            account,
            budget,
            begun: Duration::ZERO,
            spent: Duration::ZERO,
            allowance: 1.0,
            ticks: 0,
        }
    }

    /// Begins a round on this thread.
    pub fn begin(&mut self) {
        self.begun = processor_time();
    }

    /// Ends a round. Returns its processor time.
    pub fn end(&mut self) -> Duration {
        let took = processor_time().saturating_sub(self.begun);
        self.spent += took;
        took
    }

    /// Mean processor time of recent ticks.
    pub fn mean(&self) -> Duration {
        Duration::try_from_secs_f64(self.account.cost.get()).unwrap_or_default()
    }

    /// Notes that the last round did a tick, whose physics took `physics`. Returns how long the world has to rest.
    pub fn tick(&mut self, physics: Duration, figures: usize) -> Duration {
        let busy = std::mem::take(&mut self.spent);
        self.account.record(busy, physics.min(busy), figures);
        self.ticks = (self.ticks + 1) % LOOK;
        if self.ticks == 0 {
            self.allowance = self.budget.allowance(&self.account).max(0.01);
        }
        busy.mul_f64(1.0 / self.allowance - 1.0)
    }
}

/// Processor time of this thread: time in which others use the processor does not count.
#[cfg(target_os = "linux")]
fn processor_time() -> Duration {
    let t = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
    Duration::try_from(t).unwrap_or_default()
}

/// A monotonic clock, for systems on which threads have no clock of their own.
#[cfg(not(target_os = "linux"))]
fn processor_time() -> Duration {
    static START: std::sync::OnceLock<std::time::Instant> = std::sync::OnceLock::new();
    START.get_or_init(std::time::Instant::now).elapsed()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn budget(processors: f64) -> Budget {
        Budget {
            processors,
            share: 0.7,
            accounts: Mutex::default(),
        }
    }

    #[test]
    fn figures_worlds_and_clocks_fill_the_budget_and_not_more() {
        let b = budget(2.0);
        // 16 substeps at 10,000 ticks per second: not even one figure fits.
        let fast = b.open(10_000.0, 16).unwrap();
        assert!(matches!(b.add_figure(&fast), Err(Fault::Budget { .. })));
        assert!((b.used() - 0.05).abs() < 1e-9, "a refusal changes nothing");
        drop(fast);
        let a = b.open(60.0, 2).unwrap();
        let figures = (0..1000).take_while(|_| b.add_figure(&a).is_ok()).count();
        assert_eq!(figures, 129, "of 90 µs each in 70 % of a period");
        assert!(b.set_pace(&a, 120.0).is_err());
        b.set_pace(&a, 30.0).unwrap();
        b.set_pace(&a, 60.0).unwrap();
        // The machine has room for one more world like this.
        let c = b.open(0.0, 2).unwrap();
        for _ in 0..129 {
            b.add_figure(&c).unwrap(); // its clock stands still
        }
        b.set_pace(&c, 60.0).unwrap();
        let d = b.open(60.0, 2).unwrap();
        let Err(Fault::Budget { whose, percent, .. }) = (0..20).try_for_each(|_| b.add_figure(&d))
        else {
            panic!("the machine is full")
        };
        assert!(whose == "the machine" && percent > 70.0);
        b.set_pace(&c, 0.0).unwrap();
        b.add_figure(&d).unwrap();
    }

    #[test]
    fn what_is_measured_counts() {
        let b = budget(1.0);
        let a = b.open(60.0, 2).unwrap();
        b.add_figure(&a).unwrap();
        for _ in 0..400 {
            a.record(Duration::from_millis(5), Duration::from_micros(4990), 1);
        }
        assert!((a.need() - 0.3).abs() < 1e-3);
        b.add_figure(&a).unwrap();
        assert!((b.used() - 0.6).abs() < 2e-3);
        assert!(b.add_figure(&a).is_err());
        b.remove_figure(&a);
        assert!((b.used() - 0.3).abs() < 2e-3);
    }

    #[test]
    fn who_needs_much_rests_and_who_needs_little_does_not() {
        let needs = [0.1, 1.0, 1.0, 0.2];
        assert!((fair(&needs, 1.4, 3.0) - 0.55).abs() < 1e-12);
        assert_eq!(fair(&needs, 1.4, 0.2), 1.0);
        assert_eq!(fair(&needs, 3.0, 3.0), 1.0);
        assert_eq!(fair(&[1.0], 0.7, 5.0), 1.0, "there is nobody to protect");
    }

    #[test]
    fn the_meter_sees_work_and_not_sleep() {
        let b = Arc::new(budget(1.0));
        let a = b.open(60.0, 2).unwrap();
        let mut meter = Meter::new(a.clone(), b);
        meter.begin();
        // It waits for a message that never comes.
        let (_held, never) = std::sync::mpsc::sync_channel::<()>(1);
        let _ = never.recv_timeout(Duration::from_millis(200));
        meter.end();
        assert_eq!(meter.tick(Duration::ZERO, 0), Duration::ZERO);
        assert!(!cfg!(target_os = "linux") || a.cost.get() < 2e-3);
        // Work of others on the thread between two rounds is not counted; work of the round is.
        let work = |time| {
            let begun = processor_time();
            while processor_time() - begun < time {
                std::hint::spin_loop();
            }
        };
        work(Duration::from_millis(20));
        meter.begin();
        work(Duration::from_millis(2));
        let round = meter.end();
        assert!(!cfg!(target_os = "linux") || (2..10).contains(&round.as_millis()));
    }
}
