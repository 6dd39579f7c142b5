//! The programs for robots in the book, replayed: what each of them writes for a pose, in the number format of its
//! controller, is sent to a session, and the capture has that pose.
//!
//! What decides the bytes is read out of the programs: literals, formats, the order of the numbers, the end of a line.

use std::{
    fs,
    io::{ErrorKind, Read, Write},
    net::{SocketAddr, TcpStream, UdpSocket},
    process::{Child, Command, Stdio},
    thread,
    time::Duration,
};

use handeye_io::Writing;
use serde_json::Value;

use crate::line::Bench;

const PAGE: &str = include_str!("../../../../book/src/robots/programs.md");
/// Longer than any capture takes.
const PATIENCE: Duration = Duration::from_secs(120);

/// The blocks of code under a heading of the page.
fn programs(maker: &str) -> Vec<&'static str> {
    let section = after(PAGE, &format!("\n## {maker}\n"));
    let section = section.split("\n## ").next().unwrap();
    section
        .split("\n```")
        .skip(1)
        .step_by(2)
        .map(|block| block.split_once('\n').unwrap().1)
        .collect()
}

/// What follows the first of these.
fn after<'a>(text: &'a str, what: &str) -> &'a str {
    text.split_once(what).unwrap_or_else(|| panic!("no {what:?} in {text}")).1
}

/// What stands between these.
fn between<'a>(text: &'a str, begin: &str, end: &str) -> &'a str {
    after(text, begin).split(end).next().unwrap()
}

/// The parts of an expression, split where neither quotes nor parentheses are open.
fn parts(text: &str, separator: char) -> Vec<&str> {
    let (mut depth, mut quote, mut begin, mut found) = (0, None, 0, vec![]);
    for (at, c) in text.char_indices() {
        match c {
            '"' | '\'' if quote.is_none() => quote = Some(c),
            _ if quote == Some(c) => quote = None,
            _ if quote.is_some() => {}
            '(' => depth += 1,
            ')' => depth -= 1,
            _ if c == separator && depth == 0 => {
                found.push(text[begin..at].trim());
                begin = at + 1;
            }
            _ => {}
        }
    }
    found.push(text[begin..].trim());
    found
}

/// The arguments of a call, which begins with `name(`.
fn arguments<'a>(call: &'a str, name: &str) -> Option<Vec<&'a str>> {
    let inside = call.trim().strip_prefix(name)?.trim_start().strip_prefix('(')?;
    Some(parts(&inside[..inside.rfind(')')?], ','))
}

fn literal(text: &str, quote: char) -> Option<&str> {
    text.strip_prefix(quote)?.strip_suffix(quote)
}

/// The number of this name, as controllers hold it: in single precision.
fn number(names: &[&str], numbers: &[f64], name: &str) -> f64 {
    let at = names.iter().position(|own| *own == name);
    f64::from(numbers[at.unwrap_or_else(|| panic!("the pose has no {name:?}"))] as f32)
}

/// The value of an expression of URScript.
fn urscript(expression: &str, pose: &[f64]) -> String {
    if let Some(text) = literal(expression, '"') {
        return text.into();
    }
    if let Some(both) = arguments(expression, "str_cat") {
        return both.iter().map(|part| urscript(part, pose)).collect();
    }
    assert_eq!(expression, "to_str(get_actual_tool_flange_pose())");
    format!("p[{}]", pose.iter().map(|&x| six_digits(x)).collect::<Vec<_>>().join(", "))
}

/// As C's `%g`.
fn six_digits(x: f64) -> String {
    let short: f64 = format!("{x:.5e}").parse().unwrap();
    match short != 0.0 && short.abs() < 1e-4 {
        true => format!("{short:e}"),
        false => short.to_string(),
    }
}

fn sent_by_ur(pose: &[f64]) -> String {
    let mut sent = String::new();
    for line in programs("Universal Robots")[0].lines() {
        if let Some(said) = arguments(line, "socket_send_line") {
            sent += &(urscript(said[0], pose) + "\n");
        } else if let Some(said) = arguments(line, "socket_send_string") {
            sent += &urscript(said[0], pose);
        }
    }
    sent
}

/// The value of an expression of RAPID.
fn rapid(expression: &str, pose: &[f64]) -> String {
    if let Some(text) = literal(expression, '"') {
        return text.replace("\\0A", "\n").replace("\\0D", "\r");
    }
    let arguments = arguments(expression, "NumToStr").unwrap();
    let names = ["trans.x", "trans.y", "trans.z", "rot.q1", "rot.q2", "rot.q3", "rot.q4"];
    let value = number(&names, pose, arguments[0].strip_prefix("p.").unwrap());
    format!("{value:.0$}", arguments[1].parse().unwrap())
}

fn sent_by_abb(pose: &[f64]) -> String {
    let program = programs("ABB")[0];
    assert!(program.contains("p := CRobT(\\Tool:=tool0 \\WObj:=wobj0);"));
    let statements = program.split(";\n").filter(|s| s.trim().starts_with("SocketSend "));
    let sends = statements.map(|statement| {
        let expression = after(statement, "\\Str:=");
        let said: String = parts(expression, '+').iter().map(|part| rapid(part, pose)).collect();
        assert!(said.len() <= 80, "a string of RAPID has at most 80 characters: {said}");
        said
    });
    sends.collect()
}

/// `SWRITE`: a format with its values, written from an offset on.
fn swrite(said: &mut String, offset: &mut usize, arguments: &[&str], pose: &[f64]) {
    let mut format = literal(arguments[3], '"').unwrap();
    said.truncate(*offset);
    for argument in &arguments[4..] {
        let (before, rest) = format.split_once("%.").unwrap();
        let (decimals, rest) = rest.split_once('f').unwrap();
        let name = argument.strip_prefix("FLANGE.").unwrap();
        let value = number(&["X", "Y", "Z", "A", "B", "C"], pose, name);
        *said += &format!("{before}{value:.0$}", decimals.parse().unwrap());
        format = rest;
    }
    *said += format;
    *offset = said.len();
}

fn eos(xml: &str, section: &str) -> u8 {
    let section = between(xml, &format!("<{section}>"), &format!("</{section}>"));
    assert!(section.contains("Type=\"STREAM\""));
    between(section, "EOS=\"", "\"").parse().unwrap()
}

fn sent_by_kuka(pose: &[f64]) -> String {
    let [xml, krl] = programs("KUKA")[..] else { panic!("two files") };
    for line in ["$TOOL = $NULLFRAME", "$BASE = $NULLFRAME", "FLANGE = $POS_ACT"] {
        assert!(krl.contains(line), "{line}");
    }
    let (mut said, mut offset, mut sent) = (String::new(), 0, String::new());
    for line in krl.lines().map(str::trim) {
        if line == "OFS = 0" {
            offset = 0;
        } else if let Some(arguments) = arguments(line, "SWRITE") {
            assert_eq!(arguments[0], "ASKED[]");
            swrite(&mut said, &mut offset, &arguments, pose);
        } else if let Some(arguments) = arguments(line, "RET = EKI_Send") {
            assert_eq!(arguments, ["\"HandEye\"", "ASKED[]"]);
            sent += &said;
            sent.push(char::from(eos(xml, "SEND")));
        }
    }
    assert!(said.len() < 128, "ASKED is too short for {said}");
    sent
}

/// An item of KAREL's `WRITE`.
fn karel(item: &str, pose: &[f64]) -> String {
    if let Some(text) = literal(item, '\'') {
        return text.into();
    }
    if let Some(code) = arguments(item, "CHR") {
        return char::from(code[0].parse::<u8>().unwrap()).into();
    }
    let mut words = item.split("::");
    let name = words.next().unwrap().strip_prefix("flange.").unwrap();
    let value = number(&["x", "y", "z", "w", "p", "r"], pose, name);
    let mut digits = words.map(|word| word.parse::<usize>().unwrap());
    match (digits.next(), digits.next()) {
        (Some(width), Some(decimals)) => format!("{value:width$.decimals$}"),
        (width, _) => {
            let (exponent, width) = (format!("{value:.3E}"), width.unwrap_or(12));
            format!("{exponent:>width$}")
        }
    }
}

fn sent_by_fanuc(pose: &[f64]) -> String {
    let [program, caller] = programs("FANUC")[..] else { panic!("two programs") };
    for line in ["UFRAME_NUM=0", "PR[1]=LPOS", "CALL HANDEYE"] {
        assert!(caller.contains(line), "{line}");
    }
    assert!(program.contains("flange = GET_POS_REG(1, status)"));
    let writes = program.lines().filter_map(|line| arguments(line, "WRITE pc"));
    let items = writes.flatten().map(|item| karel(item, pose));
    items.collect()
}

/// Sends what a program does, and reads the answer to where the program does.
fn ask(bench: &Bench, sent: &str, end: u8) -> String {
    let mut stream = TcpStream::connect(bench.address).unwrap();
    stream.set_read_timeout(Some(PATIENCE)).unwrap();
    stream.write_all(sent.as_bytes()).unwrap();
    let (mut answer, mut byte) = (vec![], [0]);
    while answer.last() != Some(&end) {
        stream.read_exact(&mut byte).unwrap();
        answer.extend(byte);
    }
    stream.set_read_timeout(Some(Duration::from_millis(300))).unwrap();
    let more = stream.read(&mut byte).map_err(|e| e.kind());
    assert!(
        matches!(more, Err(ErrorKind::WouldBlock | ErrorKind::TimedOut)),
        "one line has one answer: {sent:?}, {more:?}"
    );
    String::from_utf8(answer).unwrap()
}

/// Runs a program before the steps are confirmed, and after: what was captured.
fn replay(bench: &Bench, sent: &str, end: u8) -> Vec<f64> {
    let refused = ask(bench, sent, end);
    assert!(refused.starts_with("error ") && refused.contains("step"), "{sent:?}: {refused}");
    bench.confirm();
    let answer = ask(bench, sent, end);
    assert!(answer.starts_with("ok 001 "), "{sent:?}: {answer}");
    assert_eq!(answer.find('\n'), Some(answer.len() - 1), "{answer}");
    captured(bench)
}

/// The numbers of the one capture.
fn captured(bench: &Bench) -> Vec<f64> {
    let journal = fs::read_to_string(bench.root.join("cell/journal.jsonl")).unwrap();
    let lines = journal.lines().map(|line| serde_json::from_str::<Value>(line).unwrap());
    let takes: Vec<Value> = lines.filter(|line| line["take"].is_object()).collect();
    assert_eq!(takes.len(), 1);
    serde_json::from_value(takes[0]["take"]["typed"].clone()).unwrap()
}

/// A session in this notation that waits for a pose, and the numbers of the pose of its image.
fn ready(notation: &str) -> (Bench, Vec<f64>) {
    let bench = Bench::of(notation);
    bench.expose();
    let pose = bench.cell.sample(0.0).base_from_flange;
    let numbers = Writing::of(notation).unwrap().numbers(&pose);
    (bench, numbers)
}

/// Positions and rotations agree within these tolerances.
#[track_caller]
fn same(read: &[f64], meant: &[f64], [position, rotation]: [f64; 2]) {
    assert_eq!(read.len(), meant.len());
    for (k, (a, b)) in read.iter().zip(meant).enumerate() {
        let tolerance = if k < 3 { position } else { rotation };
        assert!((a - b).abs() <= tolerance, "{read:?} instead of {meant:?}");
    }
}

/// Numbers of either sign and many digits stay apart in what a program sends.
#[track_caller]
fn keeps_apart(notation: &str, sent: fn(&[f64]) -> String) {
    let writing = Writing::of(notation).unwrap();
    for sign in [1.0, -1.0] {
        let pose = [1501.25, 1987.5, 1234.75, 0.5, 0.25, 0.75, 0.125].map(|x| sign * x);
        let pose = &pose[..writing.names().len()];
        let line = sent(pose);
        let numbers = line.strip_prefix("pose ").and_then(|line| line.strip_suffix('\n')).unwrap();
        same(&writing.typed_numbers(numbers).unwrap(), pose, [1e-6, 1e-6]);
    }
}

#[test]
fn the_program_of_a_ur_sends_its_pose() {
    let program = programs("Universal Robots")[0];
    let reads = between(program, "socket_read_string(", "\n");
    assert!(reads.contains("suffix=\"\\n\"") && reads.contains("interpret_escape=True"));
    keeps_apart("ur", sent_by_ur);
    let (bench, pose) = ready("ur");
    same(&replay(&bench, &sent_by_ur(&pose), b'\n'), &pose, [1e-6, 1e-5]);
}

#[test]
fn the_program_of_an_abb_sends_its_pose() {
    let end = rapid(between(programs("ABB")[0], "WHILE c <> ", " DO"), &[]);
    keeps_apart("abb", sent_by_abb);
    let (bench, pose) = ready("abb");
    same(&replay(&bench, &sent_by_abb(&pose), end.as_bytes()[0]), &pose, [6e-4, 1.2e-7]);
}

#[test]
fn the_program_of_a_kuka_sends_its_pose() {
    let [xml, krl] = programs("KUKA")[..] else { panic!("two files") };
    let receive = between(xml, "<RECEIVE>", "</RECEIVE>");
    let tag = between(receive, "Tag=\"", "\"");
    assert!(krl.contains(&format!("EKI_GetString(\"HandEye\", \"{tag}\", SAID[])")));
    for (flag, waits) in [("<ALIVE Set_Flag=\"", "WAIT FOR $FLAG["), ("Set_Flag=\"2", "IF $FLAG[2")]
    {
        assert!(xml.contains(flag) && krl.contains(waits));
    }
    keeps_apart("kuka", sent_by_kuka);
    let (bench, pose) = ready("kuka");
    same(&replay(&bench, &sent_by_kuka(&pose), eos(xml, "RECEIVE")), &pose, [1e-4, 1e-4]);
}

#[test]
fn the_program_of_a_fanuc_sends_its_pose() {
    let end = karel(between(programs("FANUC")[0], "ended = (c = ", ") OR"), &[]);
    keeps_apart("fanuc", sent_by_fanuc);
    let (bench, pose) = ready("fanuc");
    same(&replay(&bench, &sent_by_fanuc(&pose), end.as_bytes()[0]), &pose, [6e-4, 1e-4]);
}

/// A controller that is asked for its position once: the request must be as Yaskawa describes it.
fn high_speed_server(socket: &UdpSocket, pose: &[f64], tool: i32) {
    let mut request = [0; 64];
    socket.set_read_timeout(Some(PATIENCE)).unwrap();
    let (length, from) = socket.recv_from(&mut request).unwrap();
    assert_eq!(length, 32);
    assert_eq!(&request[..8], b"YERC\x20\0\0\0", "the header has 32 bytes, and no data follow");
    assert_eq!(request[8..11], [3, 1, 0], "control of a robot, a request");
    assert_eq!(&request[12..24], b"\0\0\0\x0099999999");
    assert_eq!(request[24..32], [0x75, 0, 101, 0, 0, 1, 0, 0], "the position of R1, base, all");
    let mut answer = request[..24].to_vec();
    answer[6] = 13 * 4;
    answer[10] = 1;
    answer[15] = 0x80;
    answer.extend([0x81, 0, 0, 0, 0, 0, 0, 0]);
    let steps = pose.iter().zip([1e3, 1e3, 1e3, 1e4, 1e4, 1e4]);
    let values = steps.map(|(x, per_unit)| (x * per_unit).round() as i32);
    let words = [16, 0, tool, 0, 0].into_iter().chain(values).chain([0, 0]);
    answer.extend(words.flat_map(i32::to_le_bytes));
    socket.send_to(&answer, from).unwrap();
}

/// Runs the program of the book between these; `None` where there is no Python.
fn bridge(robot: SocketAddr, session: SocketAddr) -> Option<Child> {
    let here = |program: String, name: &str, address: SocketAddr| {
        let old = format!("{name} = {}", between(&program, &format!("{name} = "), "\n"));
        program.replace(&old, &format!("{name} = (\"{}\", {})", address.ip(), address.port()))
    };
    let program = programs("Yaskawa")[0].to_owned();
    let program = here(here(program, "ROBOT", robot), "SESSION", session);
    let python = std::env::var("HANDEYE_TEST_PYTHON").unwrap_or_else(|_| "python3".into());
    let mut command = Command::new(python);
    command.args(["-c", &program]);
    command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().ok()
}

/// What the program prints when return is pressed once; the controller has this tool.
fn asked_once(bench: &Bench, pose: &[f64], tool: i32) -> Option<String> {
    let socket = UdpSocket::bind("127.0.0.1:0").unwrap();
    let mut running = bridge(socket.local_addr().unwrap(), bench.address)?;
    running.stdin.take().unwrap().write_all(b"\nq\n").unwrap();
    thread::scope(|scope| {
        scope.spawn(|| high_speed_server(&socket, pose, tool));
    });
    let ended = running.wait_with_output().unwrap();
    Some(String::from_utf8_lossy(&[ended.stdout, ended.stderr].concat()).into_owned())
}

/// `HANDEYE_TEST_PYTHON` names the interpreter (default `python3`).
#[test]
fn the_program_beside_a_yaskawa_sends_its_pose() {
    let (bench, pose) = ready("yaskawa");
    let Some(refused) = asked_once(&bench, &pose, 2) else {
        println!("SKIPPED: no python3");
        return;
    };
    assert!(refused.contains("tool 2 is active"), "{refused}");
    let early = asked_once(&bench, &pose, 0).unwrap();
    assert!(early.contains("error "), "{early}");
    bench.confirm();
    let said = asked_once(&bench, &pose, 0).unwrap();
    assert!(said.contains("ok 001 "), "{said}");
    same(&captured(&bench), &pose, [5.1e-4, 5.1e-5]);
}

/// Formats that controllers print as well.
#[test]
fn other_number_formats_of_controllers_are_read() {
    let read = |notation: &str, text: &str| Writing::of(notation).unwrap().typed_numbers(text);
    let exponents = ["6.123E+02", "-4.100E+00", "2.330E+02", "1.000E+01", "0.000E+00", "-1.70E+02"];
    let pose = Ok(vec![612.3, -4.1, 233.0, 10.0, 0.0, -170.0]);
    assert_eq!(read("fanuc", &exponents.map(|x| format!(" {x:>12}")).concat()), pose);
    let ur = read("ur", "p[0.6123, -4.1e-05, 0.233, -0, 3.25, 1e-06]");
    assert_eq!(ur, Ok(vec![0.6123, -4.1e-5, 0.233, 0.0, 3.25, 1e-6]));
    let abb = read("abb", "[612.3,-4.1,233] [1,0,0,-4.1E-05]");
    assert_eq!(abb, Ok(vec![612.3, -4.1, 233.0, 1.0, 0.0, 0.0, -4.1e-5]));
    let whole = read("abb", "[612,-4,233] [1,0,0,0]");
    assert_eq!(whole, Ok(vec![612.0, -4.0, 233.0, 1.0, 0.0, 0.0, 0.0]));
    let target = read("abb", "[[612.3,-4.1,233],[1,0,0,0]]");
    assert_eq!(target, Ok(vec![612.3, -4.1, 233.0, 1.0, 0.0, 0.0, 0.0]));
    assert!(read("fanuc", " 478.846-231.777723.728 -172.9 11.2 -92.5").is_err());
    assert!(read("fanuc", "1,2,3,4,5,6,7").unwrap_err().contains("7 numbers"));
    assert_eq!(read("kuka", "  +612.3000   -4.1000 +233.0000  +10.0 +0.0 -170.0"), pose);
}
