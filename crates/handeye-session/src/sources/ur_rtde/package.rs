//! Packages of RTDE: two bytes of size (this header included), a letter, and the rest; all numbers big-endian.
//!
//! A size has two bytes, so no package is longer than 64 KiB, whatever comes.

use std::{
    io::{ErrorKind, Read, Write},
    net::TcpStream,
    time::{Duration, Instant},
};

use super::outage::Outage;

/// Asks for a version of the protocol.
pub(super) const PROTOCOL: u8 = b'V';
/// Asks for the controller's version.
pub(super) const CONTROLLER: u8 = b'v';
/// Asks for fields.
pub(super) const OUTPUTS: u8 = b'O';
/// Begins.
pub(super) const START: u8 = b'S';
/// The fields' values.
pub(super) const DATA: u8 = b'U';
/// A text for people.
const TEXT: u8 = b'M';
/// All letters of packages that a controller sends.
const KINDS: &[u8] = b"VvOSUMPI";
/// Size and letter.
const HEADER: usize = 3;
/// Of a text so much is shown.
const SHOWN_CHARS: usize = 200;
/// Once the time is up, what has arrived already still counts.
const GRACE: Duration = Duration::from_millis(1);

/// All that is ever sent: none of it changes anything about the robot.
pub(super) enum Request<'a> {
    /// Which version of the protocol to speak.
    Protocol(u16),
    /// Which software the controller has.
    Controller,
    /// Which fields to send.
    Outputs {
        /// Their names, with commas between.
        names: &'a str,
        /// How often, in protocol 2.
        frequency_hz: Option<f64>,
    },
    /// To begin.
    Start,
}

impl Request<'_> {
    fn bytes(&self) -> Vec<u8> {
        let (kind, body) = match self {
            Self::Protocol(version) => (PROTOCOL, version.to_be_bytes().to_vec()),
            Self::Controller => (CONTROLLER, vec![]),
            Self::Outputs { names, frequency_hz } => {
                let mut body = frequency_hz.map_or(vec![], |hz| hz.to_be_bytes().to_vec());
                body.extend(names.as_bytes());
                (OUTPUTS, body)
            }
            Self::Start => (START, vec![]),
        };
        let size = (HEADER + body.len()) as u16;
        [&size.to_be_bytes()[..], &[kind], &body].concat()
    }
}

/// A package.
pub(super) struct Package {
    /// Its letter.
    pub(super) kind: u8,
    /// What follows the header.
    pub(super) body: Vec<u8>,
}

/// A connection, as packages.
pub(super) struct Wire {
    stream: TcpStream,
    /// What has come of the next packages.
    pending: Vec<u8>,
    silence: Duration,
    software: Option<String>,
    said: String,
}

impl Wire {
    /// `silence` is the time after which the other side is lost.
    pub(super) fn new(stream: TcpStream, silence: Duration) -> Self {
        // small requests are not to wait; where that cannot be set they do
        stream.set_nodelay(true).ok();
        stream.set_write_timeout(Some(silence)).ok();
        Self { stream, pending: vec![], silence, software: None, said: String::new() }
    }

    /// The controller's software, once it has said it.
    pub(super) fn software(&self) -> Option<String> {
        self.software.clone()
    }

    /// The last text that came.
    pub(super) fn said(&self) -> &str {
        &self.said
    }

    /// Sends a request.
    ///
    /// # Errors
    /// A connection that has ended.
    pub(super) fn send(&mut self, request: &Request) -> Result<(), Outage> {
        self.stream.write_all(&request.bytes()).map_err(|_| Outage::Lost)
    }

    /// Waits for the answer of this kind, and remembers what comes before it.
    ///
    /// # Errors
    /// Why it does not come.
    pub(super) fn answer(&mut self, kind: u8, until: Instant) -> Result<Vec<u8>, Outage> {
        loop {
            let package = self.next(until)?;
            match package.kind {
                CONTROLLER => self.software = version(&package.body),
                TEXT => self.said = text(&package.body),
                _ => {}
            }
            if package.kind == kind {
                return Ok(package.body);
            }
            // whoever talks of other things for ever does not answer
            if Instant::now() > until {
                return Err(Outage::Silent(self.silence));
            }
        }
    }

    /// Waits for the next package.
    ///
    /// # Errors
    /// Why it does not come.
    pub(super) fn next(&mut self, until: Instant) -> Result<Package, Outage> {
        loop {
            if let Some(package) = self.whole()? {
                return Ok(package);
            }
            let left = until.saturating_duration_since(Instant::now());
            self.stream.set_read_timeout(Some(left.max(GRACE))).map_err(|_| Outage::Lost)?;
            let mut some = [0; 4096];
            let silent = left.is_zero().then_some(Outage::Silent(self.silence));
            match self.stream.read(&mut some) {
                Ok(0) => return Err(Outage::Lost),
                Ok(count) => self.pending.extend(&some[..count]),
                Err(e) if matches!(e.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut) => {
                    silent.map_or(Ok(()), Err)?;
                    continue;
                }
                Err(e) if e.kind() == ErrorKind::Interrupted => continue,
                Err(_) => return Err(Outage::Lost),
            }
            // it came too late, unless it was there already
            if let (Some(silent), None) = (silent, self.whole_size()?) {
                return Err(silent);
            }
        }
    }

    /// The size of the next package, where all of it has come.
    fn whole_size(&self) -> Result<Option<usize>, Outage> {
        let Some([high, low, kind]) = self.pending.first_chunk::<HEADER>() else { return Ok(None) };
        let size = usize::from(u16::from_be_bytes([*high, *low]));
        if size < HEADER {
            return Err(Outage::Garbled(format!("a package of {size} bytes")));
        }
        if !KINDS.contains(kind) {
            return Err(Outage::Garbled(format!("a package of the unknown kind {kind}")));
        }
        Ok((self.pending.len() >= size).then_some(size))
    }

    fn whole(&mut self) -> Result<Option<Package>, Outage> {
        let Some(size) = self.whole_size()? else { return Ok(None) };
        let bytes: Vec<u8> = self.pending.drain(..size).collect();
        Ok(Some(Package { kind: bytes[HEADER - 1], body: bytes[HEADER..].to_vec() }))
    }
}

/// Four numbers; the first three are what people call it by.
fn version(body: &[u8]) -> Option<String> {
    let number = |k: usize| Some(u32::from_be_bytes(body.get(4 * k..4 * k + 4)?.try_into().ok()?));
    Some(format!("{}.{}.{}", number(0)?, number(1)?, number(2)?))
}

/// What can be read of a text: in protocol 1 it follows its urgency (0 to 3), in protocol 2 its length.
fn text(body: &[u8]) -> String {
    let own = match body.split_first() {
        Some((length, rest)) if *length > 3 => rest.get(..usize::from(*length)).unwrap_or(rest),
        Some((_, rest)) => rest,
        None => body,
    };
    let text = String::from_utf8_lossy(own);
    let shown = text.chars().filter(|c| !c.is_control() && *c != '\u{fffd}');
    shown.take(SHOWN_CHARS).collect()
}
