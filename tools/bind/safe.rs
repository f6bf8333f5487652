// SPDX-License-Identifier: MIT
//! peri: deformation and fracture of solids by nonlocal bonds. Made from peri.h by tools/bind.py: edit that.
//!
//! Names are those of peri.h: `peri_add_box(body, ...)` is [`Body::add_box`], `PERI_SPACE_SOLID` is [`SPACE_SOLID`]. A call that fails gives
//! an [`Error`]. A panic in a closure stops the call that it came from and goes on from there. Closures of loads, obstacles and events live
//! as long as the body and its clones, which may be on other threads: they are `Fn + Send + Sync`. An array has as many entries as peri.h
//! says, or the call fails. Where a name may be NULL, "" stands for it.
#![allow(unused_parens, unused_unsafe, clippy::all)]
use peri_sys as sys;
use std::any::Any;
use std::cell::RefCell;
use std::ffi::{c_char, c_void, CStr, CString};
use std::panic::{catch_unwind, resume_unwind, AssertUnwindSafe};
use std::sync::{Arc, Mutex};

/// What went wrong: the record of the library.
#[derive(Debug, Clone, PartialEq)]
pub struct Error {
    /// Of the `ERROR_` constants.
    pub status: i32,
    /// The name in peri.h of what is at fault, or "".
    pub field: &'static str,
    /// First offending point, entry or id; else -1.
    pub index: i64,
    /// The offending value, or the limit that was passed; else 0.
    pub value: f64,
    text: String,
}

impl std::fmt::Display for Error {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str(&self.text)
    }
}
impl std::error::Error for Error {}

pub type Result<T> = std::result::Result<T, Error>;

fn constant(text: *const c_char) -> &'static str {
    if text.is_null() {
        return "";
    }
    unsafe { CStr::from_ptr(text) }.to_str().unwrap_or("") // constant texts of the library
}

fn blank() -> sys::peri_error {
    sys::peri_error { code: 0, reserved: 0, index: -1, value: 0.0, field: c"".as_ptr(), text: c"".as_ptr() }
}

fn failed(status: i64, record: &sys::peri_error) -> Error {
    let mut one = *record;
    if i64::from(one.code) != status {
        one = blank();
        one.code = status as i32;
        one.text = unsafe { sys::peri_status_text(one.code) };
    }
    let mut text = [0 as c_char; 300];
    unsafe { sys::peri_format_error(&one, text.as_mut_ptr(), text.len() as i64) };
    let text = unsafe { CStr::from_ptr(text.as_ptr()) }.to_string_lossy().into_owned();
    Error { status: one.code, field: constant(one.field), index: one.index, value: one.value, text }
}

fn refused(field: &'static str) -> Error {
    let text = format!("{}: {}", status_text(ERROR_ARGUMENT), field);
    Error { status: ERROR_ARGUMENT, field, index: -1, value: 0.0, text }
}

fn sized(has: usize, needs: i64, field: &'static str) -> Result<()> {
    if has as i64 == needs {
        Ok(())
    } else {
        Err(refused(field))
    }
}

fn c_text(text: &str, field: &'static str) -> Result<CString> {
    CString::new(text).map_err(|_| refused(field))
}

thread_local! {
    /// The panic of a closure on this thread, until the call of the library that it came from has ended.
    static PANIC: RefCell<Option<Box<dyn Any + Send>>> = const { RefCell::new(None) };
}

fn guarded<F: FnOnce() -> i32>(call: F) -> i32 {
    catch_unwind(AssertUnwindSafe(call)).unwrap_or_else(|panic| {
        PANIC.with(|p| *p.borrow_mut() = Some(panic));
        -1
    })
}

fn go_on() {
    if let Some(panic) = PANIC.with(|p| p.borrow_mut().take()) {
        resume_unwind(panic);
    }
}

fn known(result: i64, record: &sys::peri_error) -> Result<()> {
    go_on();
    if result < 0 {
        Err(failed(result, record))
    } else {
        Ok(())
    }
}

unsafe fn slice<'a, T>(data: *const T, count: i64) -> &'a [T] {
    if data.is_null() || count <= 0 {
        &[]
    } else {
        unsafe { std::slice::from_raw_parts(data, count as usize) }
    }
}

unsafe fn slice_mut<'a, T>(data: *mut T, count: i64) -> &'a mut [T] {
    if data.is_null() || count <= 0 {
        &mut []
    } else {
        unsafe { std::slice::from_raw_parts_mut(data, count as usize) }
    }
}

type Keep = Arc<Mutex<Vec<Arc<dyn Any + Send + Sync>>>>;

fn keep(all: &Keep, one: Arc<dyn Any + Send + Sync>) {
    all.lock().unwrap_or_else(|e| e.into_inner()).push(one);
}

pub fn version() -> i32 {
    unsafe { sys::peri_version() }
}

pub fn status_text(status: i32) -> &'static str {
    constant(unsafe { sys::peri_status_text(status) })
}

/// 1, 2, ... in the order in which the ids were given.
pub const fn id_index(id: i32) -> i32 {
    id & 0xFFFFF
}

/// A field in place; it borrows the body, which stays as it is meanwhile.
pub struct View<'a> {
    raw: sys::peri_view,
    body: std::marker::PhantomData<&'a mut Body>,
}

impl View<'_> {
    pub fn points(&self) -> usize {
        self.raw.count as usize
    }
    pub fn components(&self) -> usize {
        self.raw.components as usize
    }
    fn extent(&self) -> i64 {
        let v = &self.raw;
        if v.count == 0 { 0 } else { (v.count - 1) * v.point_stride + i64::from(v.components - 1) * v.component_stride + 1 }
    }
    /// The numbers as they lie in the body: component k of point i at i*point_stride + k*component_stride. None: of another type.
    pub fn doubles(&self) -> Option<&[f64]> {
        (self.raw.r#type == TYPE_F64).then(|| unsafe { slice(self.raw.data as *const f64, self.extent()) })
    }
    pub fn floats(&self) -> Option<&[f32]> {
        (self.raw.r#type == TYPE_F32).then(|| unsafe { slice(self.raw.data as *const f32, self.extent()) })
    }
    pub fn integers(&self) -> Option<&[i32]> {
        (self.raw.r#type == TYPE_I32).then(|| unsafe { slice(self.raw.data as *const i32, self.extent()) })
    }
    pub fn point_stride(&self) -> usize {
        self.raw.point_stride as usize
    }
    pub fn component_stride(&self) -> usize {
        self.raw.component_stride as usize
    }
    /// Component k of point i in your units.
    pub fn at(&self, i: usize, k: usize) -> f64 {
        let n = i * self.point_stride() + k * self.component_stride();
        let number = if let Some(d) = self.doubles() {
            d[n]
        } else if let Some(d) = self.floats() {
            f64::from(d[n])
        } else {
            f64::from(self.integers().unwrap_or(&[])[n])
        };
        self.raw.offset[if k < 3 { k } else { 0 }] + self.raw.scale * number
    }
}
