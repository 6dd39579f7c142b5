//! Arms out of URDF reach where another reader, yourdfpy, says.
//! `HANDEYE_TEST_PYTHON` names the interpreter (default `python3`).

use std::{fs, process::Command};

use handeye_io::Urdf;

/// Writes chains of joints of every kind, each with a branch that does not belong to it, and prints joint values and
/// matrices: arm, base, number of joints, values, 16 numbers by rows.
const WRITE: &str = "
import sys, numpy, yourdfpy
random = numpy.random.default_rng(1)
words = lambda v: ' '.join(repr(float(x)) for x in v)
def joint(name, kind, parent, child, axis):
    return (f'<joint name=\"{name}\" type=\"{kind}\"><parent link=\"{parent}\"/><child link=\"{child}\"/>'
        f'<origin xyz=\"{words(random.uniform(-.7, .7, 3))}\" rpy=\"{words(random.uniform(-3.1, 3.1, 3))}\"/>'
        f'<axis xyz=\"{words(axis)}\"/><limit lower=\"-3\" upper=\"3\" effort=\"1\" velocity=\"1\"/></joint>')
for k in range(40):
    links = ['base_link', *(f'link{i}' for i in range(random.integers(2, 9))), 'tool0']
    kinds = ['revolute', 'revolute', *random.choice(['revolute', 'continuous', 'prismatic', 'fixed'], len(links) - 3)]
    axes = [random.normal(size=3) if random.random() < .5 else numpy.eye(3)[random.integers(3)] for _ in kinds]
    text = ''.join(joint(f'j{i}', kind, links[i], links[i + 1], a / numpy.linalg.norm(a))
        for i, (kind, a) in enumerate(zip(kinds, axes)))
    text += joint('mount', 'fixed', 'link0', 'camera', [0, 0, 1]) + joint('side', 'fixed', 'base_link', 'base', [0, 0, 1])
    path = f'{sys.argv[1]}/{k}.urdf'
    open(path, 'w').write('<robot name=\"arm\">' + ''.join(f'<link name=\"{l}\"/>' for l in [*links, 'camera', 'base']) + text + '</robot>')
    arm = yourdfpy.URDF.load(path, load_meshes=False, build_scene_graph=True)
    for _ in range(4):
        q = random.uniform(-3, 3, len(arm.actuated_joint_names))
        arm.update_cfg(dict(zip(arm.actuated_joint_names, q)))
        for base in ['base_link', 'base']:
            print(k, base, len(q), words(q), words(arm.get_transform('tool0', base).ravel()))
";

#[test]
fn arms_reach_where_another_reader_says() {
    let python = std::env::var("HANDEYE_TEST_PYTHON").unwrap_or_else(|_| "python3".into());
    let import = Command::new(&python).args(["-c", "import yourdfpy"]).output();
    if !import.is_ok_and(|o| o.status.success()) {
        println!("SKIPPED: {python} has no module yourdfpy");
        return;
    }
    let folder = std::env::temp_dir().join(format!("handeye-arms-{}", std::process::id()));
    fs::create_dir_all(&folder).unwrap();
    let run = Command::new(python).args(["-c", WRITE]).arg(&folder).output().unwrap();
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    let said = String::from_utf8(run.stdout).unwrap();
    let (mut most, mut count) = (0.0f64, 0);
    for line in said.lines() {
        let mut words = line.split_whitespace();
        let path = folder.join(format!("{}.urdf", words.next().unwrap()));
        let base = words.next().unwrap();
        let joints: usize = words.next().unwrap().parse().unwrap();
        let numbers: Vec<f64> = words.map(|w| w.parse().unwrap()).collect();
        let (values, theirs) = numbers.split_at(joints);
        let urdf = Urdf::read(&path, base, "tool0").unwrap();
        assert_eq!(urdf.joint_names().len(), joints, "{}", path.display());
        let ours = urdf.arm().base_from_flange(values).iso().to_homogeneous();
        for (k, value) in theirs.iter().enumerate() {
            most = most.max((ours[(k / 4, k % 4)] - value).abs());
        }
        count += 1;
    }
    println!("{count} poses of 40 arms differ by at most {most:.1e}");
    assert!(count == 320 && most < 1e-9, "{count}: {most}");
    fs::remove_dir_all(folder).unwrap();
}
