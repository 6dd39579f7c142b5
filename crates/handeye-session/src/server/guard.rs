//! Who may ask: those who have the token, from no page but the session's own.

use std::time::Duration;

use axum::{
    body::Body,
    extract::{Request, State},
    http::{HeaderMap, StatusCode, header},
    middleware::Next,
    response::{IntoResponse, Response},
};

use super::routes::{App, refusal};

/// The token, and the cookie that holds it.
#[derive(Clone)]
pub(super) struct Guard {
    token: String,
    cookie: String,
}

impl Guard {
    /// With a new token; cookies of one machine are shared by all its ports, so its name holds that.
    pub(super) fn new(port: u16) -> Result<Self, getrandom::Error> {
        let mut bytes = [0; 16];
        getrandom::fill(&mut bytes)?;
        let token = bytes.iter().map(|byte| format!("{byte:02x}")).collect();
        Ok(Self { token, cookie: format!("handeye_{port}") })
    }

    pub(super) fn token(&self) -> &str {
        &self.token
    }

    /// Takes as long for a token that is nearly right.
    fn is_token(&self, given: &str) -> bool {
        let (a, b) = (given.as_bytes(), self.token.as_bytes());
        a.len() == b.len() && a.iter().zip(b).fold(0, |off, (a, b)| off | (a ^ b)) == 0
    }

    fn has_token(&self, headers: &HeaderMap) -> bool {
        let text = |name| headers.get(name).and_then(|value| value.to_str().ok());
        let bearer = text(header::AUTHORIZATION).and_then(|v| v.strip_prefix("Bearer "));
        let cookies = text(header::COOKIE).unwrap_or_default().split(';');
        let own = |cookie: &str| {
            let (name, value) = cookie.trim().split_once('=')?;
            (name == self.cookie).then(|| value.to_owned())
        };
        let cookie = cookies.map(own).find_map(|value| value);
        bearer.is_some_and(|given| self.is_token(given))
            || cookie.is_some_and(|given| self.is_token(&given))
    }
}

/// A host that no other page can have by its name: an address of a machine, or this one.
fn is_own_host(host: &str) -> bool {
    let name = match host.rsplit_once(':') {
        Some((name, port)) if port.bytes().all(|b| b.is_ascii_digit()) => name,
        _ => host,
    };
    let address = name.trim_start_matches('[').trim_end_matches(']');
    name == "localhost" || address.parse::<std::net::IpAddr>().is_ok()
}

/// Refuses everything that does not come from the session's own page or a script with the token.
pub(super) async fn check(State(app): State<App>, request: Request, next: Next) -> Response {
    let headers = request.headers();
    let text = |name| headers.get(name).and_then(|value| value.to_str().ok());
    let host = text(header::HOST).unwrap_or_default().to_owned();
    if !is_own_host(&host) {
        return refusal(
            StatusCode::FORBIDDEN,
            "not this host",
            "open the address that the session has printed",
        );
    }
    let is_own = |origin: &str| origin == format!("http://{host}");
    if headers.contains_key(header::ORIGIN) && !text(header::ORIGIN).is_some_and(is_own) {
        return refusal(StatusCode::FORBIDDEN, "another page asks", "open the session's own page");
    }
    let guard = &app.guard;
    if let Some(given) = token_in(request.uri().query()).filter(|_| request.uri().path() == "/") {
        if !guard.is_token(given) {
            return not_signed_in();
        }
        let cookie = format!("{}={given}; Path=/; HttpOnly; SameSite=Strict", guard.cookie);
        let to = [(header::LOCATION, "/".to_owned()), (header::SET_COOKIE, cookie)];
        return (StatusCode::SEE_OTHER, to, Body::empty()).into_response();
    }
    if !guard.has_token(headers) {
        return not_signed_in();
    }
    let length = text(header::CONTENT_LENGTH).and_then(|length| length.parse().ok());
    let most = if request.uri().path() == UPLOAD { LARGEST_IMAGE } else { LARGEST_COMMAND };
    if length.is_some_and(|bytes: u64| bytes > most as u64) {
        return too_large(most);
    }
    let answered = tokio::time::timeout(PATIENCE, next.run(request)).await;
    answered.unwrap_or_else(|_| {
        refusal(StatusCode::REQUEST_TIMEOUT, "the request has not come to its end", "ask again")
    })
}

/// Where images are uploaded.
pub(super) const UPLOAD: &str = "/api/image";
/// No command is longer, bytes.
pub(super) const LARGEST_COMMAND: usize = 1 << 20;
/// No image's file is larger, bytes.
pub(super) const LARGEST_IMAGE: usize = 128 << 20;
/// A request that is still being sent after so long is given up.
const PATIENCE: Duration = Duration::from_secs(60);

fn token_in(query: Option<&str>) -> Option<&str> {
    query?.split('&').find_map(|pair| pair.strip_prefix("token="))
}

/// More than this many bytes are not taken.
pub(super) fn too_large(most: usize) -> Response {
    let advice = format!("at most {} MiB are taken", most >> 20);
    refusal(StatusCode::PAYLOAD_TOO_LARGE, "this is too much", &advice)
}

fn not_signed_in() -> Response {
    refusal(
        StatusCode::UNAUTHORIZED,
        "no token, or that of another session",
        "open the address that the session has printed",
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_that_another_could_own_are_no_hosts_of_ours() {
        for (host, own) in [
            ("127.0.0.1:8080", true),
            ("localhost:80", true),
            ("[::1]:8080", true),
            ("192.168.1.7", true),
            ("evil.example:8080", false),
            ("127.0.0.1.evil.example", false),
            ("", false),
        ] {
            assert_eq!(is_own_host(host), own, "{host}");
        }
    }
}
