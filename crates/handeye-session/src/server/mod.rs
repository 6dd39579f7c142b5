//! The session's page and its API over HTTP: loopback unless asked otherwise, a token, and nobody else's pages.

mod guard;
pub mod line;
pub(crate) mod routes;

use std::{
    io,
    net::{IpAddr, SocketAddr, TcpListener},
};

use crate::live::Live;
use guard::Guard;

/// A server that listens, before it serves.
pub struct Server {
    listener: TcpListener,
    guard: Guard,
    live: Live,
}

impl Server {
    /// Listens; port 0 is any that is free.
    ///
    /// # Errors
    /// A port that is in use, an address that is none of this machine.
    pub fn bind(live: Live, address: IpAddr, port: u16) -> io::Result<Self> {
        let listener = TcpListener::bind(SocketAddr::new(address, port))?;
        listener.set_nonblocking(true)?;
        let guard = Guard::new(listener.local_addr()?.port())
            .map_err(|e| io::Error::other(e.to_string()))?;
        Ok(Self { listener, guard, live })
    }

    /// The address to open; it holds the token.
    ///
    /// # Errors
    /// A socket that is gone.
    pub fn address(&self) -> io::Result<String> {
        let at = self.listener.local_addr()?;
        let host = match at.ip() {
            ip if ip.is_unspecified() => "127.0.0.1".into(),
            IpAddr::V6(ip) => format!("[{ip}]"),
            IpAddr::V4(ip) => ip.to_string(),
        };
        Ok(format!("http://{host}:{}/?token={}", at.port(), self.guard.token()))
    }

    /// Serves until the program ends.
    ///
    /// # Errors
    /// What the system says.
    pub fn serve(self) -> io::Result<()> {
        let runtime =
            tokio::runtime::Builder::new_multi_thread().worker_threads(2).enable_all().build()?;
        runtime.block_on(async {
            let listener = tokio::net::TcpListener::from_std(self.listener)?;
            let router = routes::router(self.live, self.guard);
            axum::serve(listener, router).await
        })
    }
}
