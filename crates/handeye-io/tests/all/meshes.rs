//! Every kind of mesh file gives the same surface.

use std::{
    fs,
    path::{Path, PathBuf},
};

use handeye_io::{is_mesh, read_mesh, units::LengthUnit};

/// A pyramid of four sides, one corner at the origin, mm.
const VERTICES: [[f32; 3]; 5] = [
    [0.0, 0.0, 0.0],
    [20.0, 0.0, 0.0],
    [20.0, 20.0, 0.125],
    [0.0, 20.0, 0.0],
    [10.0, 10.0, 30.125],
];
/// Its sides, and its bottom as a polygon.
const SIDES: [[u32; 3]; 4] = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]];
const BOTTOM: [u32; 4] = [0, 3, 2, 1];

/// All triangles, the bottom cut from its first corner.
fn triangles() -> Vec<[u32; 3]> {
    [&SIDES[..], &[[0, 3, 2], [0, 2, 1]]].concat()
}

fn file(name: &str, content: impl AsRef<[u8]>) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("handeye-meshes-{}", std::process::id()));
    fs::create_dir_all(&folder).unwrap();
    let path = folder.join(name);
    fs::write(&path, content).unwrap();
    path
}

/// The places of all triangles' corners, m.
fn placed(vertices: &[[f32; 3]], triangles: &[[u32; 3]]) -> Vec<[[f32; 3]; 3]> {
    triangles.iter().map(|t| t.map(|v| vertices[v as usize])).collect()
}

fn is_the_pyramid(path: &Path) {
    assert!(is_mesh(path), "{}", path.display());
    let mesh = read_mesh(path, Some(LengthUnit::Millimetre)).unwrap();
    let metres = VERTICES.map(|v| v.map(|x| (f64::from(x) / 1000.0) as f32));
    assert_eq!(mesh.vertices().len(), 5, "{}", path.display());
    let found = placed(mesh.vertices(), mesh.triangles());
    assert_eq!(found, placed(&metres, &triangles()), "{}", path.display());
    let question = read_mesh(path, None).unwrap_err().to_string();
    assert!(question.contains("length_unit is missing; are the vertices in"), "{question}");
}

fn binary_stl(title: &str) -> Vec<u8> {
    let mut bytes = format!("{title:<80}").into_bytes();
    bytes.extend(6u32.to_le_bytes());
    for corners in placed(&VERTICES, &triangles()) {
        bytes.extend([0; 12]);
        bytes.extend(corners.as_flattened().iter().flat_map(|x| x.to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}

fn text_stl() -> String {
    let facet = |corners: &[[f32; 3]; 3]| {
        let line = |v: &[f32; 3]| format!("      vertex {:e} {} {}\n", v[0], v[1], v[2]);
        let lines: String = corners.iter().map(line).collect();
        format!("  facet normal 0 0 1\n    outer loop\n{lines}    endloop\n  endfacet\n")
    };
    let facets: String = placed(&VERTICES, &triangles()).iter().map(facet).collect();
    format!("solid a part of vertex 1\n{facets}endsolid a part\n")
}

#[test]
fn stl_in_binary_and_text() {
    is_the_pyramid(&file("binary.stl", binary_stl("made by a program")));
    is_the_pyramid(&file("solid.STL", binary_stl("solid but binary")));
    is_the_pyramid(&file("more.stl", [binary_stl("bytes behind the end"), vec![0; 7]].concat()));
    is_the_pyramid(&file("text.stl", text_stl()));
    is_the_pyramid(&file("dos.stl", text_stl().to_uppercase().replace('\n', "\r\n")));
}

#[test]
fn obj_with_every_notation_of_corners() {
    let vertices: String =
        VERTICES.iter().map(|v| format!("v {} {} {} 0.5 0.5 0.5\n", v[0], v[1], v[2])).collect();
    let faces = |corner: &dyn Fn(u32) -> String| -> String {
        let face = |f: &[u32]| f.iter().fold("f".to_owned(), |t, v| t + " " + &corner(*v)) + "\n";
        SIDES.iter().map(|f| face(f)).collect::<String>() + &face(&BOTTOM)
    };
    let head = "# a part\nmtllib part.mtl\no part\nvt 0 0\nvn 0 0 1\n";
    let notations: [(&str, &dyn Fn(u32) -> String); 5] = [
        ("plain.obj", &|v| format!("{}", v + 1)),
        ("texture.obj", &|v| format!("{}/1", v + 1)),
        ("all.obj", &|v| format!("{}/1/1", v + 1)),
        ("normal.obj", &|v| format!("{}//1", v + 1)),
        ("back.obj", &|v| format!("{}", i64::from(v) - 5)),
    ];
    for (name, corner) in notations {
        let text = format!("{head}{vertices}s off\ng sides # all\n{}", faces(corner));
        is_the_pyramid(&file(name, text));
    }
}

/// Header, vertices and faces of a PLY file.
fn ply(format: &str, number: &dyn Fn(f32) -> Vec<u8>, index: &dyn Fn(u32) -> Vec<u8>) -> Vec<u8> {
    let header = format!(
        "ply\nformat {format} 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n\
         element face 5\nproperty uchar flags\nproperty list uchar int vertex_indices\nend_header\n"
    );
    let is_text = format == "ascii";
    let count = |n: u8| if is_text { format!("{n} ").into_bytes() } else { vec![n] };
    let end = if is_text { vec![b'\n'] } else { vec![] };
    let mut bytes = header.into_bytes();
    for v in VERTICES {
        bytes.extend(v.iter().flat_map(|x| number(*x)));
        bytes.extend(&end);
    }
    for face in SIDES.iter().map(|f| &f[..]).chain([&BOTTOM[..]]) {
        bytes.extend([count(7), count(face.len() as u8)].concat());
        bytes.extend(face.iter().flat_map(|v| index(*v)));
        bytes.extend(&end);
    }
    bytes
}

#[test]
fn ply_with_faces_of_all_three_encodings() {
    let text = |x: f32| format!("{x} ").into_bytes();
    let index = |v: u32| format!("{v} ").into_bytes();
    is_the_pyramid(&file("a.ply", ply("ascii", &text, &index)));
    let little =
        ply("binary_little_endian", &|x| x.to_le_bytes().into(), &|v| v.to_le_bytes().into());
    is_the_pyramid(&file("l.ply", little));
    let big = ply("binary_big_endian", &|x| x.to_be_bytes().into(), &|v| v.to_be_bytes().into());
    is_the_pyramid(&file("b.ply", big));
}

#[test]
fn a_cloud_is_no_mesh() {
    let cloud = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nelement face 0\nproperty list uchar int vertex_indices\nend_header\n1 2 3\n";
    assert!(!is_mesh(&file("cloud.ply", cloud)));
    assert!(!is_mesh(&file("cloud.xyz", "1 2 3\n")));
    assert!(!is_mesh(Path::new("nowhere.ply")));
}

#[test]
fn broken_meshes_are_refused() {
    let cut = |bytes: Vec<u8>, end: usize| bytes[..end].to_vec();
    let little =
        ply("binary_little_endian", &|x| x.to_le_bytes().into(), &|v| v.to_le_bytes().into());
    let length = little.len();
    let of_text = |content: &str| content.as_bytes().to_vec();
    let mut absurd = binary_stl("");
    absurd[80..84].copy_from_slice(&4_000_000_000u32.to_le_bytes());
    let mut infinite = binary_stl("");
    infinite[96..100].copy_from_slice(&f32::INFINITY.to_le_bytes());
    let header = |faces: &str| {
        format!(
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face {faces}\nend_header\n0 0 0\n1 0 0\n0 1 0\n"
        )
    };
    let list = "property list uchar int vertex_indices";
    let cases = [
        (
            "cut.stl",
            cut(binary_stl(""), 383),
            "cut.stl: is cut short: the header promises 6 triangles; copy or record it again",
        ),
        (
            "absurd.stl",
            absurd,
            "absurd.stl: the number of triangles is 4000000000, more than the limit of 100000000; is the file damaged?",
        ),
        ("short.stl", of_text("no stl"), "short.stl: is no STL file; export it as STL again"),
        ("empty.stl", vec![], "empty.stl: the file is empty; record it again"),
        (
            "none.stl",
            cut(
                binary_stl("")
                    .iter()
                    .enumerate()
                    .map(|(k, b)| if k == 80 { 0 } else { *b })
                    .collect(),
                84,
            ),
            "none.stl: the mesh has no triangle; export the mesh again",
        ),
        (
            "infinite.stl",
            infinite,
            "infinite.stl: vertex 1 of the mesh, (inf, 0, 0) m, is not finite or beyond any robot and camera; export the mesh again",
        ),
        (
            "cut_text.stl",
            of_text(&text_stl()[..300]),
            "cut_text.stl: is cut short: its last line is not endsolid; copy or export it again",
        ),
        (
            "two.stl",
            of_text(&text_stl().replacen("vertex 1e1 10 30.125", "", 1)),
            "two.stl:7: a facet of 2 corners; export it as STL again",
        ),
        (
            "word.stl",
            of_text(&text_stl().replacen("30.125", "top", 1)),
            "word.stl:6: a vertex without three numbers; export it as STL again",
        ),
        (
            "vertex.obj",
            of_text("v 1 2\n"),
            "vertex.obj:1: a vertex without three numbers; export it as OBJ again",
        ),
        (
            "zero.obj",
            of_text("v 1 2 3\nf 0 1 1\n"),
            "zero.obj:2: a face with a corner \"0\"; export it as OBJ again",
        ),
        (
            "before.obj",
            of_text("v 1 2 3\nf -1 -2 1\n"),
            "before.obj:2: a face with a corner \"-2\"; export it as OBJ again",
        ),
        (
            "beyond.obj",
            of_text("v 1 2 3\nf 1 1 2\n"),
            "beyond.obj: triangle 1 of the mesh has a vertex that is not there: [0, 0, 1] of 1, counted from 0; export the mesh again",
        ),
        (
            "points.obj",
            of_text("v 1 2 3\n"),
            "points.obj: the mesh has no triangle; export the mesh again",
        ),
        (
            "cut.ply",
            cut(little.clone(), length - 3),
            "cut.ply: is cut short: the header promises 5 faces; copy or record it again",
        ),
        (
            "many.ply",
            of_text(&header(&format!("4000000000\n{list}"))),
            "many.ply: the number of faces is 4000000000, more than the limit of 100000000; is the file damaged?",
        ),
        (
            "negative.ply",
            of_text(&format!("{}3 0 1 -2\n", header(&format!("1\n{list}")))),
            "negative.ply: triangle 1 of the mesh has a vertex that is not there: [0, 1, 4294967295] of 3, counted from 0; export the mesh again",
        ),
        (
            "listless.ply",
            of_text(&header("1\nproperty int a")),
            "listless.ply: its faces have no list vertex_indices; export it as PLY again",
        ),
        (
            "long.ply",
            of_text(&format!("{}200 0 1 2\n", header(&format!("1\n{list}")))),
            "long.ply: is cut short: the header promises 1 faces; copy or record it again",
        ),
        (
            "part.step",
            of_text("x"),
            "part.step: meshes of kind \".step\" cannot be read; STL, OBJ and PLY can; export one of them",
        ),
    ];
    for (name, content, expected) in cases {
        let path = file(name, content);
        let error = read_mesh(&path, Some(LengthUnit::Metre)).err();
        let error = error.unwrap_or_else(|| panic!("{name} was accepted"));
        let folder = format!("{}/", path.parent().unwrap().display());
        assert_eq!(error.to_string().replace(&folder, ""), expected);
    }
}
