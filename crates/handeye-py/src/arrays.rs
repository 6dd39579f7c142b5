//! Arrays as rotations, translations, poses and points.

use handeye_io::robot::rotation_near;
use nalgebra::{Matrix3, Matrix4, Vector3};
use numpy::{PyArray2, PyArrayDyn, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::{prelude::*, types::PyDict};

use crate::errors::input;

/// No cell is so large, in metres or millimetres.
const FARTHEST: f64 = 1e9;

/// A few numbers and their shape.
struct Few {
    numbers: [f64; 16],
    count: usize,
    is_square: bool,
}

/// Numbers of an array, or of what NumPy makes one of.
fn few(item: &Bound<'_, PyAny>) -> PyResult<Few> {
    let mut numbers = [0.0; 16];
    if let Ok(array) = item.cast::<PyArray2<f64>>() {
        let (rows, columns) = (array.shape()[0], array.shape()[1]);
        let count = rows * columns;
        if count <= numbers.len() {
            for (k, number) in numbers[..count].iter_mut().enumerate() {
                *number = array.get_owned([k / columns, k % columns]).unwrap_or(f64::NAN);
            }
        }
        return Ok(Few { numbers, count, is_square: rows == columns });
    }
    if let Ok(array) = item.cast::<PyArrayDyn<f64>>() {
        let read = array.readonly();
        let view = read.as_array();
        numbers.iter_mut().zip(view.iter()).for_each(|(n, x)| *n = *x);
        return Ok(Few { numbers, count: view.len(), is_square: false });
    }
    few(&as_array(item)?)
}

/// As an array of doubles.
fn as_array<'py>(item: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    let py = item.py();
    let numpy = py.import("numpy")?;
    let refused = |error: PyErr| input(format!("no array of numbers: {}", error.value(py)));
    let given = numpy.call_method1("asarray", (item,)).map_err(refused)?;
    let kind: char = given.getattr("dtype")?.getattr("kind")?.extract()?;
    if !"fiubO".contains(kind) {
        let what = given.getattr("dtype")?.str()?;
        return Err(input(format!("no array of real numbers, but of {what}")));
    }
    let options = PyDict::new(py);
    options.set_item("dtype", "float64")?;
    numpy.call_method("asarray", (given,), Some(&options)).map_err(refused)
}

/// A 3 x 3 matrix, or a rotation vector of three numbers (rad).
pub fn rotation(item: &Bound<'_, PyAny>, name: &str, k: usize) -> PyResult<Matrix3<f64>> {
    let few = few(item).map_err(|e| input(format!("{name}[{k}]: {}", e.value(item.py()))))?;
    if few.numbers.iter().any(|x| !x.is_finite()) {
        return Err(input(format!("{name}[{k}] holds a number that is NaN or infinite")));
    }
    match (few.count, few.is_square) {
        (9, true) => {
            let matrix = Matrix3::from_row_slice(&few.numbers[..9]);
            nearest_rotation(&matrix, &format!("{name}[{k}]"))
        }
        (3, _) => {
            let vector = Vector3::from_column_slice(&few.numbers[..3]);
            Ok(nalgebra::Rotation3::from_scaled_axis(vector).into_inner())
        }
        _ => Err(input(format!(
            "{name}[{k}] has {} numbers: give a 3 x 3 matrix, or a rotation vector of 3 (rad)",
            few.count
        ))),
    }
}

/// The rotation that a matrix is but for rounding; refuses what turns nothing, mirrors or stretches.
fn nearest_rotation(matrix: &Matrix3<f64>, name: &str) -> PyResult<Matrix3<f64>> {
    let found = rotation_near(matrix).map_err(|what| input(format!("{name}: {what}")))?;
    Ok(found.to_rotation_matrix().into_inner())
}

/// Three numbers, in a row or a column.
pub fn translation(item: &Bound<'_, PyAny>, name: &str, k: usize) -> PyResult<Vector3<f64>> {
    let few = few(item).map_err(|e| input(format!("{name}[{k}]: {}", e.value(item.py()))))?;
    if few.count != 3 {
        return Err(input(format!("{name}[{k}] has {} numbers: a translation has 3", few.count)));
    }
    let vector = Vector3::from_column_slice(&few.numbers[..3]);
    if vector.iter().any(|x| !x.is_finite()) {
        return Err(input(format!("{name}[{k}] holds a number that is NaN or infinite")));
    }
    if vector.amax() > FARTHEST {
        return Err(input(format!(
            "{name}[{k}] lies {:.1e} away, beyond any robot or camera",
            vector.amax()
        )));
    }
    Ok(vector)
}

/// Homogeneous matrices, N x 4 x 4.
pub fn poses(array: &Bound<'_, PyAny>, name: &str) -> PyResult<Vec<(Matrix3<f64>, Vector3<f64>)>> {
    let array = as_array(array)?;
    let array = array.cast::<PyArrayDyn<f64>>()?;
    let shape = array.shape().to_vec();
    let [_, 4, 4] = shape[..] else {
        return Err(input(format!("{name} has the shape {shape:?}: N x 4 x 4 is needed")));
    };
    let read = array.readonly();
    let numbers: Vec<f64> = read.as_array().iter().copied().collect();
    numbers
        .chunks_exact(16)
        .enumerate()
        .map(|(k, numbers)| {
            let named = format!("{name}[{k}]");
            if numbers.iter().any(|x| !x.is_finite()) {
                return Err(input(format!("{named} holds a number that is NaN or infinite")));
            }
            let matrix = Matrix4::from_row_slice(numbers);
            if matrix.row(3) != Matrix4::identity().row(3) {
                return Err(input(format!(
                    "{named} is no rigid transform: its last row is not 0 0 0 1"
                )));
            }
            let rotation = matrix.fixed_view::<3, 3>(0, 0).into_owned();
            let rotation = nearest_rotation(&rotation, &named)?;
            Ok((rotation, matrix.fixed_view::<3, 1>(0, 3).into_owned()))
        })
        .collect()
}

/// One homogeneous matrix, 4 x 4.
pub fn pose(array: &Bound<'_, PyAny>, name: &str) -> PyResult<(Matrix3<f64>, Vector3<f64>)> {
    let array = as_array(array)?;
    let shape = array.cast::<PyArrayDyn<f64>>()?.shape().to_vec();
    if shape != [4, 4] {
        return Err(input(format!("{name} has the shape {shape:?}: 4 x 4 is needed")));
    }
    let one = poses(&array.call_method1("reshape", (1, 4, 4))?, name)?;
    one.into_iter().next().ok_or_else(|| input(format!("{name} is empty")))
}

/// Points as they lie in an array, N x 3 or H x W x 3: columns, rows, and all points.
pub fn points(array: &Bound<'_, PyAny>, name: &str) -> PyResult<(usize, usize, Vec<[f32; 3]>)> {
    fn taken<T: numpy::Element + Copy>(
        array: &Bound<'_, PyArrayDyn<T>>,
        single: impl Fn(T) -> f32,
    ) -> Vec<[f32; 3]> {
        let read = array.readonly();
        let view = read.as_array();
        let mut numbers = view.iter().map(|x| single(*x));
        let mut points = Vec::with_capacity(view.len() / 3);
        while let (Some(x), Some(y), Some(z)) = (numbers.next(), numbers.next(), numbers.next()) {
            points.push([x, y, z]);
        }
        points
    }
    let given = match array.cast::<PyArrayDyn<f32>>() {
        Ok(_) => array.clone(),
        Err(_) => as_array(array)?,
    };
    let (shape, points) = match given.cast::<PyArrayDyn<f32>>() {
        Ok(array) if is_of_points(array.shape()) => (array.shape().to_vec(), taken(array, |x| x)),
        Ok(array) => (array.shape().to_vec(), vec![]),
        Err(_) => {
            let array = given.cast::<PyArrayDyn<f64>>()?;
            let shape = array.shape().to_vec();
            let points = if is_of_points(&shape) { taken(array, |x| x as f32) } else { vec![] };
            (shape, points)
        }
    };
    match shape[..] {
        [count, 3] => Ok((count, 1, points)),
        [rows, columns, 3] => Ok((columns, rows, points)),
        _ => {
            Err(input(format!("{name} has the shape {shape:?}: N x 3 or H x W x 3 is needed (m)")))
        }
    }
}

fn is_of_points(shape: &[usize]) -> bool {
    matches!(shape, [_, 3] | [_, _, 3])
}

/// As an array of 3 x 3.
pub fn of_rotation<'py>(py: Python<'py>, r: &Matrix3<f64>) -> PyResult<Bound<'py, PyArray2<f64>>> {
    rows(py, &(0..3).map(|i| (0..3).map(|j| r[(i, j)]).collect()).collect::<Vec<_>>())
}

/// As an array of 3 x 1.
pub fn of_translation<'py>(
    py: Python<'py>,
    t: &Vector3<f64>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    rows(py, &t.iter().map(|x| vec![*x]).collect::<Vec<_>>())
}

/// As an array.
pub fn rows<'py>(py: Python<'py>, rows: &[Vec<f64>]) -> PyResult<Bound<'py, PyArray2<f64>>> {
    PyArray2::from_vec2(py, rows).map_err(|error| input(error.to_string()))
}
