//! A controller of Universal Robots at a socket, so far as RTDE goes (protocols 1 and 2), with what goes wrong.

use std::{
    io::{self, ErrorKind, Read, Write},
    net::{SocketAddr, TcpListener, TcpStream},
    sync::{
        Arc, Mutex, MutexGuard,
        atomic::{AtomicBool, AtomicUsize, Ordering},
    },
    thread,
    time::Duration,
};

use handeye::math::random::Random;

use crate::ur_fields::{size_of_type, type_of};

/// Where the arm is: what a controller reports.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Arm {
    /// rad.
    pub joints: [f64; 6],
    /// `base_from_tcp`: x y z (m), rotation vector (rad).
    pub tcp_pose: [f64; 6],
    /// `flange_from_tcp`, likewise.
    pub tcp_offset: [f64; 6],
    /// 7 where it runs.
    pub mode: i32,
}

pub const ARM: Arm = Arm {
    joints: [0.1, -1.2, 1.3, -0.4, 1.5, -6.1],
    tcp_pose: [0.312_345, -0.456_789, 0.567_891, 2.1, -1.9, 0.3],
    tcp_offset: [0.0, 0.012, 0.152_4, 0.02, -0.3, 1.1],
    mode: 7,
};

/// What becomes of a connection.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum End {
    Never,
    /// It is closed after so many data packages.
    Drops(usize),
    /// Then half a package, and silence.
    Half(usize),
    /// Then silence.
    Silent(usize),
    /// The controller's clock stands from then on.
    Frozen(usize),
    /// Then these bytes.
    Says(usize, &'static [u8]),
    /// Random bytes from the first moment, or good ones with errors.
    Noise,
    /// Texts without end, and nothing else.
    Talks,
}

/// How a controller behaves.
#[derive(Debug, Clone, Copy)]
pub struct Manner {
    /// The newest protocol that it speaks.
    pub protocol: u16,
    pub end: End,
    /// Byte by byte.
    pub split: bool,
    /// Of what it reads at once it obeys the first request, and loses the others.
    pub one_each: bool,
    /// A field that it does not have, and one that has another type.
    pub missing: &'static [&'static str],
    pub retyped: &'static str,
    /// Whether it begins when it is asked.
    pub starts: bool,
    /// Between two packages; its clock goes on as it was asked.
    pub interval: Duration,
    pub arm: Arm,
}

pub const GOOD: Manner = Manner {
    protocol: 2,
    end: End::Never,
    split: false,
    one_each: false,
    missing: &[],
    retyped: "",
    starts: true,
    interval: Duration::from_millis(5),
    arm: ARM,
};

#[derive(Clone)]
pub struct Simulator {
    pub address: SocketAddr,
    manner: Arc<Mutex<Manner>>,
    pub connections: Arc<AtomicUsize>,
    /// Letters of all that was asked of it.
    pub asked: Arc<Mutex<Vec<u8>>>,
    ends: Arc<AtomicBool>,
}

impl Simulator {
    pub fn start(manner: Manner) -> Self {
        Self::at("127.0.0.1:0".parse().unwrap(), manner).unwrap()
    }

    pub fn at(address: SocketAddr, manner: Manner) -> io::Result<Self> {
        let listener = TcpListener::bind(address)?;
        let simulator = Self {
            address: listener.local_addr()?,
            manner: Arc::new(Mutex::new(manner)),
            connections: Arc::default(),
            asked: Arc::default(),
            ends: Arc::default(),
        };
        let own = simulator.clone();
        thread::spawn(move || {
            for stream in listener.incoming().flatten() {
                if own.ends.load(Ordering::Acquire) {
                    return;
                }
                let number = own.connections.fetch_add(1, Ordering::AcqRel);
                let own = own.clone();
                // whoever hangs up is gone
                thread::spawn(move || Talk::new(own, stream, number as u64).serve().ok());
            }
        });
        Ok(simulator)
    }

    pub fn manner(&self) -> MutexGuard<'_, Manner> {
        self.manner.lock().unwrap()
    }

    pub fn port(&self) -> u16 {
        self.address.port()
    }

    pub fn stop(&self) {
        self.ends.store(true, Ordering::Release);
        TcpStream::connect(self.address).ok();
    }
}

/// One connection.
struct Talk {
    simulator: Simulator,
    stream: TcpStream,
    random: Random,
    protocol: u16,
    fields: Vec<String>,
    step_s: f64,
    time_s: f64,
    runs: bool,
    sent: usize,
}

impl Talk {
    fn new(simulator: Simulator, stream: TcpStream, number: u64) -> Self {
        stream.set_nodelay(true).unwrap();
        Self {
            simulator,
            stream,
            random: Random::new(number),
            protocol: 1,
            fields: vec![],
            step_s: 0.008,
            time_s: 100.0,
            runs: false,
            sent: 0,
        }
    }

    fn manner(&self) -> Manner {
        *self.simulator.manner()
    }

    fn serve(mut self) -> io::Result<()> {
        let mut pending = vec![];
        match self.manner().end {
            End::Talks => loop {
                self.send(b'M', b"\x04talkhere\x00")?;
            },
            End::Noise if self.random.unit() < 0.5 => {
                let bytes = self.noise(300);
                return self.stream.write_all(&bytes);
            }
            _ => {}
        }
        while !self.simulator.ends.load(Ordering::Acquire) {
            // zero is no timeout
            let interval = self.manner().interval.max(Duration::from_micros(1));
            self.stream.set_read_timeout(Some(interval))?;
            let mut some = [0; 4096];
            match self.stream.read(&mut some) {
                Ok(0) => return Ok(()),
                Ok(count) => pending.extend(&some[..count]),
                Err(e) if matches!(e.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut) => {
                    if self.runs && !self.tick()? {
                        return Ok(());
                    }
                }
                Err(e) => return Err(e),
            }
            while pending.len() >= 3 {
                let size = usize::from(u16::from_be_bytes([pending[0], pending[1]]));
                assert!(size >= 3, "a request of {size} bytes");
                if pending.len() < size {
                    break;
                }
                let request: Vec<u8> = pending.drain(..size).collect();
                self.obey(request[2], &request[3..])?;
                if self.manner().one_each {
                    pending.clear();
                }
            }
        }
        Ok(())
    }

    fn obey(&mut self, kind: u8, body: &[u8]) -> io::Result<()> {
        self.simulator.asked.lock().unwrap().push(kind);
        match kind {
            b'V' => {
                let wanted = u16::from_be_bytes(body.try_into().unwrap());
                let speaks = wanted <= self.manner().protocol;
                self.protocol = if speaks { wanted } else { self.protocol };
                self.send(b'V', &[u8::from(speaks)])
            }
            b'v' => {
                let version = [5u32, 11, 6, 1].map(u32::to_be_bytes).concat();
                self.send(b'v', &version)
            }
            b'O' => self.agree(body),
            b'S' => {
                self.runs = self.manner().starts;
                if !self.runs {
                    self.say("no recipe")?;
                }
                self.send(b'S', &[u8::from(self.runs)])
            }
            b'P' => {
                self.runs = false;
                self.send(b'P', &[1])
            }
            _ => self.say("not understood"),
        }
    }

    fn say(&mut self, text: &str) -> io::Result<()> {
        let body = match self.protocol {
            1 => [&[2], text.as_bytes()].concat(),
            _ => [&[text.len() as u8], text.as_bytes(), b"\x04RTDE\x02"].concat(),
        };
        self.send(b'M', &body)
    }

    fn agree(&mut self, body: &[u8]) -> io::Result<()> {
        let names = match self.protocol {
            1 => body,
            _ => {
                let (hz, names) = body.split_first_chunk::<8>().unwrap();
                self.step_s = 1.0 / f64::from_be_bytes(*hz);
                names
            }
        };
        let names = std::str::from_utf8(names).unwrap();
        self.fields = names.split(',').filter(|n| !n.is_empty()).map(str::to_owned).collect();
        let manner = self.manner();
        let kind = |name: &String| match &name[..] {
            name if manner.missing.contains(&name) => "NOT_FOUND",
            name if manner.retyped == name => "UINT64",
            name => type_of(name),
        };
        let types = self.fields.iter().map(kind).collect::<Vec<_>>().join(",");
        let id: &[u8] = if self.protocol == 1 { &[] } else { &[1] };
        self.send(b'O', &[id, types.as_bytes()].concat())
    }

    /// Sends the next values; whether the connection is kept.
    fn tick(&mut self) -> io::Result<bool> {
        let manner = self.manner();
        let values = self.values(&manner.arm);
        match manner.end {
            End::Drops(count) if self.sent >= count => return Ok(false),
            End::Silent(count) if self.sent >= count => return Ok(true),
            End::Half(count) if self.sent >= count => {
                if self.sent == count {
                    self.sent += 1;
                    let package = package(b'U', &values);
                    self.write(&package[..package.len() / 2])?;
                }
                return Ok(true);
            }
            End::Says(count, bytes) if self.sent >= count => {
                self.write(bytes)?;
                return Ok(true);
            }
            End::Frozen(count) if self.sent >= count => {}
            _ => self.time_s += self.step_s,
        }
        self.sent += 1;
        self.send(b'U', &values)?;
        Ok(true)
    }

    fn values(&self, arm: &Arm) -> Vec<u8> {
        let id: &[u8] = if self.protocol == 1 { &[] } else { &[1] };
        let mut body = id.to_vec();
        let six = |numbers: &[f64; 6]| numbers.map(f64::to_be_bytes).concat();
        for name in &self.fields {
            body.extend(match &name[..] {
                "timestamp" => self.time_s.to_be_bytes().to_vec(),
                "actual_q" => six(&arm.joints),
                "actual_TCP_pose" => six(&arm.tcp_pose),
                "tcp_offset" => six(&arm.tcp_offset),
                "robot_mode" => arm.mode.to_be_bytes().to_vec(),
                other => vec![0; size_of_type(type_of(other))],
            });
        }
        body
    }

    fn send(&mut self, kind: u8, body: &[u8]) -> io::Result<()> {
        let mut bytes = package(kind, body);
        if self.manner().end == End::Noise {
            // one of the bytes is another one, most of the time
            let at = (self.random.between(0.0, 1.5) * bytes.len() as f64) as usize;
            if let Some(byte) = bytes.get_mut(at) {
                *byte ^= self.noise(1)[0];
            }
        }
        self.write(&bytes)
    }

    fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        match self.manner().split {
            false => self.stream.write_all(bytes),
            true => bytes.iter().try_for_each(|byte| {
                self.stream.write_all(&[*byte])?;
                thread::yield_now();
                Ok(())
            }),
        }
    }

    fn noise(&mut self, count: usize) -> Vec<u8> {
        (0..count).map(|_| self.random.bits() as u8).collect()
    }
}

fn package(kind: u8, body: &[u8]) -> Vec<u8> {
    [&((3 + body.len()) as u16).to_be_bytes()[..], &[kind], body].concat()
}
