//! What the server answers.

use std::{sync::Arc, time::Duration};

use axum::{
    Router,
    body::{Body, Bytes, to_bytes},
    extract::{Path, Query, State},
    http::{HeaderName, HeaderValue, StatusCode, header},
    middleware,
    response::{IntoResponse, Response},
    routing::{MethodRouter, get, post},
};
use handeye_io::{export, read_image, read_result, small_jpeg};
use serde::Deserialize;
use serde_json::{Value, json};
use tokio::sync::Semaphore;

use super::guard::{self, Guard, LARGEST_COMMAND, LARGEST_IMAGE, UPLOAD};
use crate::{engine::Command, host::RESULT, live::Live};

/// What every answer needs.
#[derive(Clone)]
pub(super) struct App {
    pub(super) live: Live,
    pub(super) guard: Guard,
    /// One image at a time is uploaded.
    uploading: Arc<Semaphore>,
}

/// A state that does not change is sent again after so long.
const STATE_PATIENCE: Duration = Duration::from_secs(20);
/// An image is waited for so long.
const IMAGE_PATIENCE: Duration = Duration::from_secs(5);
/// Width of images on the page, px.
const IMAGE_WIDTH: usize = 1280;
/// No script but the page's own, nothing from elsewhere.
const POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; \
     connect-src 'self'; frame-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
/// A report is a page with its scripts in it: it may do nothing else.
const REPORT_POLICY: &str = "sandbox allow-scripts; default-src 'none'; script-src 'unsafe-inline'; \
     style-src 'unsafe-inline'; img-src data: blob:; font-src data:";

/// All that is answered; `openapi.json` describes it.
fn routes() -> [(&'static str, MethodRouter<App>); 12] {
    [
        ("/", get(page)),
        ("/session.js", get(script)),
        ("/session.css", get(style)),
        ("/api/openapi.json", get(description)),
        ("/api/state", get(state)),
        ("/api/do", post(command)),
        (UPLOAD, post(upload)),
        ("/api/live.jpg", get(live_image)),
        ("/api/captures/{name}", get(capture)),
        ("/api/report", get(report)),
        ("/api/formats", get(formats)),
        ("/api/export", get(exported)),
    ]
}

/// Where something is answered.
#[cfg(test)]
pub(crate) fn paths() -> Vec<&'static str> {
    routes().into_iter().map(|(path, _)| path).collect()
}

pub(super) fn router(live: Live, guard: Guard) -> Router {
    let app = App { live, guard, uploading: Arc::new(Semaphore::new(1)) };
    let all = routes().into_iter();
    all.fold(Router::new(), |router, (path, answer)| router.route(path, answer))
        .fallback(nothing_there)
        .layer(middleware::from_fn_with_state(app.clone(), guard::check))
        .with_state(app)
}

/// An error as every answer has it.
pub(super) fn refusal(status: StatusCode, message: &str, advice: &str) -> Response {
    answer_json(status, &json!({ "error": { "message": message, "advice": advice } }))
}

fn answer_json(status: StatusCode, value: &Value) -> Response {
    content(status, "application/json", value.to_string().into())
}

/// Bytes of a type, with what keeps browsers from making something else of them.
fn content(status: StatusCode, of: &'static str, bytes: Bytes) -> Response {
    let fixed = HeaderValue::from_static;
    let headers = [
        (header::CONTENT_TYPE, fixed(of)),
        (header::CONTENT_SECURITY_POLICY, fixed(POLICY)),
        (header::X_CONTENT_TYPE_OPTIONS, fixed("nosniff")),
        (header::REFERRER_POLICY, fixed("no-referrer")),
        (header::CACHE_CONTROL, fixed("no-store")),
    ];
    (status, headers, bytes).into_response()
}

async fn page() -> Response {
    content(
        StatusCode::OK,
        "text/html; charset=utf-8",
        include_bytes!("../../web/dist/index.html").as_slice().into(),
    )
}

async fn script() -> Response {
    content(
        StatusCode::OK,
        "text/javascript; charset=utf-8",
        include_bytes!("../../web/dist/session.js").as_slice().into(),
    )
}

async fn style() -> Response {
    content(
        StatusCode::OK,
        "text/css; charset=utf-8",
        include_bytes!("../../web/dist/session.css").as_slice().into(),
    )
}

async fn description() -> Response {
    let document = include_bytes!("../../openapi.json").as_slice();
    content(StatusCode::OK, "application/json", document.into())
}

async fn nothing_there() -> Response {
    refusal(StatusCode::NOT_FOUND, "there is nothing here", "see the list of addresses in the book")
}

#[derive(Deserialize)]
struct After {
    after: Option<u64>,
}

async fn state(State(app): State<App>, Query(After { after }): Query<After>) -> Response {
    let mut shown = app.live.shown();
    let newer = shown.wait_for(|state| state.version > after.unwrap_or(0));
    tokio::time::timeout(STATE_PATIENCE, newer).await.ok();
    let json = shown.borrow_and_update().json.clone();
    content(StatusCode::OK, "application/json", Bytes::copy_from_slice(json.as_bytes()))
}

async fn command(State(app): State<App>, body: Body) -> Response {
    let Ok(body) = to_bytes(body, LARGEST_COMMAND).await else {
        return guard::too_large(LARGEST_COMMAND);
    };
    let command = match Command::from_json(&body) {
        Ok(command) => command,
        Err(error) => {
            let message = format!("this is no command: {error}");
            return refusal(
                StatusCode::BAD_REQUEST,
                &message,
                "commands are like {\"do\": \"take\"}",
            );
        }
    };
    match app.live.command(command).await {
        Ok(version) => answer_json(StatusCode::OK, &json!({ "version": version })),
        Err(why) => {
            let status = if why.later { StatusCode::CONFLICT } else { StatusCode::BAD_REQUEST };
            refusal(status, &why.message, "")
        }
    }
}

/// An image's file, as the body.
async fn upload(State(app): State<App>, body: Body) -> Response {
    let Some(uploads) = app.live.uploads().cloned() else {
        let advice = "begin the session with --upload";
        return refusal(StatusCode::CONFLICT, "images come by themselves in this session", advice);
    };
    let Ok(turn) = app.uploading.clone().try_acquire_owned() else {
        let what = "another image is being uploaded";
        return refusal(StatusCode::CONFLICT, what, "one at a time: send it again then");
    };
    let Ok(body) = to_bytes(body, LARGEST_IMAGE).await else {
        return guard::too_large(LARGEST_IMAGE);
    };
    let taken = tokio::task::spawn_blocking(move || {
        let taken = uploads.image(&body);
        drop(turn);
        taken
    });
    match taken.await {
        Ok(Ok(())) => answer_json(StatusCode::OK, &json!({})),
        Ok(Err(why)) => refusal(StatusCode::BAD_REQUEST, &why, "PNG, JPEG, TIFF and BMP are read"),
        Err(_) => refusal(StatusCode::BAD_REQUEST, "the image cannot be read", "save it again"),
    }
}

async fn live_image(State(app): State<App>, Query(After { after }): Query<After>) -> Response {
    let mut frames = app.live.frames();
    let newer = frames.wait_for(|frame| *frame > after.unwrap_or(0));
    if tokio::time::timeout(IMAGE_PATIENCE, newer).await.is_err() {
        return StatusCode::NO_CONTENT.into_response();
    }
    let Some((frame, image)) = app.live.newest_image() else {
        return StatusCode::NO_CONTENT.into_response();
    };
    let shrunk = tokio::task::spawn_blocking(move || small_jpeg(&image.grey, IMAGE_WIDTH)).await;
    let Some((jpeg, ..)) = shrunk.ok().flatten() else {
        return StatusCode::NO_CONTENT.into_response();
    };
    let mut response = content(StatusCode::OK, "image/jpeg", jpeg.into());
    response.headers_mut().insert(HeaderName::from_static("x-frame"), frame.into());
    response
}

/// The image of a capture, or what was measured in it: its name is a number, and nothing else is looked for.
async fn capture(State(app): State<App>, Path(name): Path<String>) -> Response {
    let missing = || refusal(StatusCode::NOT_FOUND, "there is no such capture", "");
    let Some((id, ending)) = name.split_once('.').filter(|(id, _)| is_id(id)) else {
        return missing();
    };
    match ending {
        "json" => {
            let details = app.live.shown().borrow().details.clone();
            match details.iter().find(|detail| detail.id == id) {
                Some(detail) => answer_json(StatusCode::OK, &json!(detail)),
                None => missing(),
            }
        }
        "jpg" => {
            let (folder, id) = (app.live.folder().to_path_buf(), id.to_owned());
            let small = move || small_jpeg(&capture_image(&folder, &id)?, IMAGE_WIDTH);
            match tokio::task::spawn_blocking(small).await.ok().flatten() {
                Some((jpeg, ..)) => content(StatusCode::OK, "image/jpeg", jpeg.into()),
                None => missing(),
            }
        }
        _ => missing(),
    }
}

/// A capture's image, whether it stands or was deleted.
fn capture_image(folder: &std::path::Path, id: &str) -> Option<handeye::GrayImage> {
    let places = ["images", "verification", "placements"];
    let deleted = places.map(|name| folder.join("deleted").join(name));
    let places = places.map(|name| folder.join(name));
    let mut files = { places.iter().chain(&deleted) }
        .filter_map(|path| std::fs::read_dir(path).ok())
        .flatten()
        .flatten();
    let is_own = |file: &std::fs::DirEntry| file.path().file_stem().is_some_and(|stem| stem == id);
    read_image(&files.find(is_own)?.path(), None).ok()
}

fn is_id(id: &str) -> bool {
    let id = id.strip_prefix(['v', 'p']).unwrap_or(id);
    (1..=4).contains(&id.len()) && id.bytes().all(|byte| byte.is_ascii_digit())
}

async fn report(State(app): State<App>) -> Response {
    match std::fs::read(app.live.folder().join(RESULT).join("report.html")) {
        Ok(page) => {
            let mut response = content(StatusCode::OK, "text/html; charset=utf-8", page.into());
            let policy = HeaderValue::from_static(REPORT_POLICY);
            response.headers_mut().insert(header::CONTENT_SECURITY_POLICY, policy);
            response
        }
        Err(_) => {
            refusal(StatusCode::NOT_FOUND, "there is no report yet", "finish the captures first")
        }
    }
}

async fn formats() -> Response {
    let all: Vec<Value> =
        export::Format::names().into_iter().map(|name| json!({ "name": name })).collect();
    answer_json(StatusCode::OK, &json!(all))
}

#[derive(Deserialize)]
struct Wanted {
    format: String,
}

/// Whether views that verify the result contradict it.
fn is_contradicted(live: &Live) -> bool {
    let state: Value = serde_json::from_str(&live.shown().borrow().json).unwrap_or_default();
    state["verify"]["agrees"] == false
}

async fn exported(State(app): State<App>, Query(Wanted { format }): Query<Wanted>) -> Response {
    let bad = |what: &str| refusal(StatusCode::BAD_REQUEST, what, "");
    let format = match export::Format::named(&format) {
        Ok(format) => format,
        Err(what) => return bad(&what),
    };
    let path = app.live.folder().join(RESULT).join("calibration.json");
    let result = match read_result(&path) {
        Ok(result) => result,
        Err(error) => {
            return refusal(StatusCode::CONFLICT, &error.to_string(), "finish the captures first");
        }
    };
    if result.verdict != handeye::Verdict::Accepted {
        let what = "the result is not accepted, and is not exported";
        return refusal(StatusCode::CONFLICT, what, "take more captures");
    }
    if is_contradicted(&app.live) {
        let what = "the verification contradicts the result, and it is not exported";
        return refusal(StatusCode::CONFLICT, what, "see the step `verify`");
    }
    match export::CameraPose::of(&result, None, None, std::slice::from_ref(&format)) {
        Ok(Some(pose)) => {
            let name = format.file_name(pose.name);
            let mut response = content(
                StatusCode::OK,
                "application/octet-stream",
                export::render(&pose, &format).into(),
            );
            if let Ok(value) = HeaderValue::from_str(&format!("attachment; filename=\"{name}\"")) {
                response.headers_mut().insert(header::CONTENT_DISPOSITION, value);
            }
            response
        }
        Ok(None) => refusal(StatusCode::CONFLICT, "the result determines no pose", ""),
        Err(what) => bad(&what),
    }
}
