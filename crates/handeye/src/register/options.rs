//! Which method, and how far it looks.

/// What is compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum DenseMethod {
    /// Distances along the mean of both normals (symmetric).
    #[default]
    Symmetric,
    /// Distances between places. Where surfaces are flat this creeps, and of dense clouds it holds on to places that
    /// are millimetres off: neighbours along the surface lie as near as the right one. That is rejected.
    PointToPoint,
    /// Distances along the target's normal.
    PointToPlane,
    /// Distances, by how windows are spread along and across both surfaces (generalised ICP).
    PlaneToPlane,
}

impl DenseMethod {
    /// Every method.
    pub const ALL: [DenseMethod; 4] = [
        DenseMethod::Symmetric,
        DenseMethod::PointToPoint,
        DenseMethod::PointToPlane,
        DenseMethod::PlaneToPlane,
    ];

    /// The name in files and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            DenseMethod::Symmetric => "symmetric",
            DenseMethod::PointToPoint => "point-to-point",
            DenseMethod::PointToPlane => "point-to-plane",
            DenseMethod::PlaneToPlane => "gicp",
        }
    }

    /// The method of that name; `auto` is what the symmetric one was called first.
    pub fn from_name(name: &str) -> Option<DenseMethod> {
        let name = if name == "auto" { "symmetric" } else { name };
        DenseMethod::ALL.into_iter().find(|method| method.name() == name)
    }
}

/// When to match and when to stop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DenseConfig {
    /// What is compared.
    pub method: DenseMethod,
    /// Windows farther apart are not compared, m.
    pub max_correspondence_distance_m: f64,
    /// Most rounds over all windows; and over some, from each start.
    pub max_iterations: usize,
    /// A round that moves no window by more is the last, m. Zero leaves that to what is known of the noise.
    pub transformation_epsilon_m: f64,
    /// A round that changes the RMS distance by no more than this share is the last.
    pub fitness_epsilon: f64,
    /// Whether starts around the given one are tried as well.
    pub restarts: bool,
    /// Whether to look for starts everywhere, and not near the given one.
    pub global: bool,
    /// Threads; the answer is the same with any number.
    pub threads: usize,
}

impl Default for DenseConfig {
    fn default() -> Self {
        Self {
            method: DenseMethod::Symmetric,
            max_correspondence_distance_m: 0.05,
            max_iterations: 60,
            transformation_epsilon_m: 0.0,
            fitness_epsilon: 0.0,
            restarts: true,
            global: false,
            threads: 1,
        }
    }
}
