//! Functions that the libraries of this process may have or not.

use std::ffi::{CStr, c_char, c_void};
use std::ptr::{self, NonNull};

unsafe extern "C" {
    fn dlsym(library: *mut c_void, name: *const c_char) -> *mut c_void;
}

/// The first function of a name in the process, as the linker looks for it.
pub(super) fn function(name: &CStr) -> Option<NonNull<c_void>> {
    // SAFETY: the name ends with a zero; a null handle asks all libraries of the process.
    NonNull::new(unsafe { dlsym(ptr::null_mut(), name.as_ptr()) })
}
