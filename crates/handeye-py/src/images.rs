//! Targets in images.

use std::path::PathBuf;

use handeye::{GrayImage, ImageCorner, TargetModel, detect as detection};
use handeye_io::read_target;
use numpy::{PyArray1, PyArray2, PyArray3, PyArrayDyn, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::{prelude::*, types::PyDict};

use crate::{errors, working};

/// Ids, pixels (N x 2) and covariances (N x 2 x 2) of the corners; `None` and why, where there is no target.
#[pyfunction]
#[pyo3(signature = (image, *, target_json=None, target_file=None))]
pub fn detect<'py>(
    py: Python<'py>,
    image: &Bound<'py, PyAny>,
    target_json: Option<&str>,
    target_file: Option<PathBuf>,
) -> PyResult<Bound<'py, PyDict>> {
    let target = target(py, target_json, target_file)?;
    let image = picture(image)?;
    let found = working::compute(py, move || detection::detect(&image, &target))?;
    let answer = PyDict::new(py);
    let (corners, reason) = match found {
        Ok(corners) => (corners, None),
        Err(reason) => (vec![], Some(reason.to_string())),
    };
    answer.set_item("reason", reason)?;
    set(py, &answer, &corners)?;
    Ok(answer)
}

fn set(py: Python<'_>, answer: &Bound<'_, PyDict>, corners: &[ImageCorner]) -> PyResult<()> {
    let ids: Vec<u32> = corners.iter().map(|c| c.id).collect();
    answer.set_item("ids", PyArray1::from_vec(py, ids))?;
    let pixels = PyArray2::zeros(py, [corners.len(), 2], false);
    let covariances = PyArray3::zeros(py, [corners.len(), 2, 2], false);
    {
        let (mut pixels, mut covariances) = (pixels.readwrite(), covariances.readwrite());
        let (mut pixels, mut covariances) = (pixels.as_array_mut(), covariances.as_array_mut());
        for (k, corner) in corners.iter().enumerate() {
            for i in 0..2 {
                pixels[[k, i]] = corner.pixel[i];
                for j in 0..2 {
                    covariances[[k, i, j]] = corner.covariance[(i, j)];
                }
            }
        }
    }
    answer.set_item("pixels", pixels)?;
    answer.set_item("covariances", covariances)
}

pub fn target(py: Python<'_>, json: Option<&str>, file: Option<PathBuf>) -> PyResult<TargetModel> {
    if let Some(file) = file {
        return read_target(&file).map_err(|error| errors::of_files(py, &error));
    }
    target_from_json(json.unwrap_or("null"))
}

/// The target that a dict describes.
pub fn target_from_json(text: &str) -> PyResult<TargetModel> {
    let target: TargetModel =
        serde_json::from_str(text).map_err(|error| errors::input(format!("no target: {error}")))?;
    target.check().map_err(|error| errors::of_core(&error))?;
    Ok(target)
}

/// Grey values of H x W, or of H x W x 3 in the order of OpenCV or its reverse, or of H x W x 4 with what the fourth says
/// left out; 8 or 16 bits, or floating.
pub fn picture(image: &Bound<'_, PyAny>) -> PyResult<GrayImage> {
    let wrong = |shape: &[usize]| {
        errors::input(format!(
            "the image has the shape {shape:?}: H x W, H x W x 3 or H x W x 4 is needed"
        ))
    };
    fn grey<T: numpy::Element + Copy>(
        array: &Bound<'_, PyArrayDyn<T>>,
        value: impl Fn(T) -> f32,
    ) -> Option<GrayImage> {
        let shape = array.shape().to_vec();
        let read = array.readonly();
        let mut numbers = read.as_array().into_iter().map(|v| value(*v));
        let (height, width, channels) = match shape[..] {
            [height, width] => (height, width, 1),
            [height, width, channels @ (3 | 4)] => (height, width, channels),
            _ => return None,
        };
        if channels == 1 {
            return GrayImage::new(width, height, numbers.collect());
        }
        let mut values = Vec::with_capacity(height * width);
        while let (Some(a), Some(b), Some(c)) = (numbers.next(), numbers.next(), numbers.next()) {
            values.push(0.25 * a + 0.5 * b + 0.25 * c);
            if channels == 4 {
                numbers.next();
            }
        }
        GrayImage::new(width, height, values)
    }
    if let Ok(array) = image.cast::<PyArrayDyn<u8>>() {
        return grey(array, f32::from).ok_or_else(|| wrong(array.shape()));
    }
    if let Ok(array) = image.cast::<PyArrayDyn<u16>>() {
        // 10, 12 and 14 bits are kept in 16 as well
        let read = array.readonly();
        let largest = read.as_array().iter().copied().max().unwrap_or(0);
        let bits =
            [8, 10, 12, 14].into_iter().find(|bits| u32::from(largest) < 1 << bits).unwrap_or(16);
        let scale = 255.0 / ((1u32 << bits) - 1) as f32;
        return grey(array, |v| f32::from(v) * scale).ok_or_else(|| wrong(array.shape()));
    }
    if let Ok(array) = image.cast::<PyArrayDyn<f32>>() {
        return up_to_255(grey(array, |v| v).ok_or_else(|| wrong(array.shape()))?);
    }
    if let Ok(array) = image.cast::<PyArrayDyn<f64>>() {
        return up_to_255(grey(array, |v| v as f32).ok_or_else(|| wrong(array.shape()))?);
    }
    Err(errors::input("the image must be an array of uint8, uint16, float32 or float64 (0 to 255)"))
}

/// Floating images from 0 to 1 are so dark to us that no board would be found in them.
fn up_to_255(picture: GrayImage) -> PyResult<GrayImage> {
    let brightest = picture.values().iter().copied().fold(0.0, f32::max);
    if brightest > 0.0 && brightest <= 1.0 {
        let what = "the image has no value above 1: from 0 to 255 is needed; multiply it by 255";
        return Err(errors::input(what));
    }
    Ok(picture)
}
