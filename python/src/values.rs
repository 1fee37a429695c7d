//! Values of Python, TOML and JSON, one as another.

use crate::errors;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyList, PyMapping, PySequence, PyString};
use serde_json::Value;

/// JSON as Python has it.
pub(crate) fn to_python<'py>(py: Python<'py>, value: &Value) -> PyResult<Bound<'py, PyAny>> {
    Ok(match value {
        Value::Null => py.None().into_bound(py),
        Value::Bool(flag) => PyBool::new(py, *flag).to_owned().into_any(),
        Value::Number(number) => match (number.as_i64(), number.as_u64()) {
            (Some(integer), _) => integer.into_pyobject(py)?.into_any(),
            (None, Some(integer)) => integer.into_pyobject(py)?.into_any(),
            (None, None) => number.as_f64().into_pyobject(py)?.into_any(),
        },
        Value::String(text) => PyString::new(py, text).into_any(),
        Value::Array(items) => {
            let items = items.iter().map(|item| to_python(py, item)).collect::<PyResult<Vec<_>>>()?;
            PyList::new(py, items)?.into_any()
        }
        Value::Object(entries) => {
            let table = PyDict::new(py);
            for (key, value) in entries {
                table.set_item(key, to_python(py, value)?)?;
            }
            table.into_any()
        }
    })
}

/// What serialises as JSON, as Python has it.
pub(crate) fn dict<'py>(py: Python<'py>, value: &impl serde::Serialize) -> PyResult<Bound<'py, PyDict>> {
    let value = serde_json::to_value(value).map_err(|error| errors::failed(py, error))?;
    Ok(to_python(py, &value)?.cast_into::<PyDict>()?)
}

/// A value of Python as a case file would have it; arrays and scalars of NumPy, and paths, count as what they hold.
pub(crate) fn to_toml(value: &Bound<'_, PyAny>) -> PyResult<toml::Value> {
    if let Ok(flag) = value.cast::<PyBool>() {
        return Ok(toml::Value::Boolean(flag.is_true()));
    }
    if value.hasattr("tolist")? {
        return to_toml(&value.call_method0("tolist")?);
    }
    if value.is_instance_of::<PyInt>() {
        return Ok(toml::Value::Integer(value.extract()?));
    }
    if value.is_instance_of::<PyFloat>() {
        return Ok(toml::Value::Float(value.extract()?));
    }
    if value.is_instance_of::<PyString>() {
        return Ok(toml::Value::String(value.extract()?));
    }
    if value.hasattr("__fspath__")? {
        return Ok(toml::Value::String(value.call_method0("__fspath__")?.extract()?));
    }
    if let Ok(table) = value.cast::<PyMapping>() {
        return Ok(toml::Value::Table(to_table(table)?));
    }
    if let Ok(items) = value.cast::<PySequence>() {
        let items = items.try_iter()?.map(|item| to_toml(&item?)).collect::<PyResult<_>>()?;
        return Ok(toml::Value::Array(items));
    }
    let kind = value.get_type().qualname()?;
    Err(PyTypeError::new_err(format!("expected text, a number, True, False, a list or a dict, found {kind}")))
}

/// A dict as a table.
pub(crate) fn to_table(table: &Bound<'_, PyMapping>) -> PyResult<toml::Table> {
    let entry = |item: Bound<'_, PyAny>| -> PyResult<(String, toml::Value)> {
        let (key, value): (Bound<'_, PyAny>, Bound<'_, PyAny>) = item.extract()?;
        Ok((key.extract()?, to_toml(&value)?))
    };
    table.items()?.iter().map(entry).collect()
}
