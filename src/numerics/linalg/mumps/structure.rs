//! MUMPS's C structure, field by field as `smumps_c.h` and `dmumps_c.h` of version 5.5 have it.

use std::ffi::{c_char, c_int};
use std::ptr::NonNull;

/// Version whose structure this is, to the second number; `build.rs` refuses headers of another one.
pub(super) const VERSION: &str = "5.5.";

/// A pointer of C that may be null.
type Pointer<T> = Option<NonNull<T>>;

/// `SMUMPS_STRUC_C` for `f32`, `DMUMPS_STRUC_C` for `f64`. All zeros are a valid value of every field.
#[repr(C)]
pub(in crate::numerics::linalg) struct Structure<T> {
    pub sym: c_int,
    pub par: c_int,
    pub job: c_int,
    pub comm_fortran: c_int,
    pub icntl: [c_int; 60],
    keep: [c_int; 500],
    pub cntl: [T; 15],
    dkeep: [T; 230],
    keep8: [i64; 150],
    pub n: c_int,
    pub nblk: c_int,
    nz_alloc: c_int,
    nz: c_int,
    pub nnz: i64,
    pub irn: Pointer<c_int>,
    pub jcn: Pointer<c_int>,
    pub a: Pointer<T>,
    nz_loc: c_int,
    nnz_loc: i64,
    irn_loc: Pointer<c_int>,
    jcn_loc: Pointer<c_int>,
    a_loc: Pointer<T>,
    nelt: c_int,
    eltptr: Pointer<c_int>,
    eltvar: Pointer<c_int>,
    a_elt: Pointer<T>,
    pub blkptr: Pointer<c_int>,
    blkvar: Pointer<c_int>,
    pub perm_in: Pointer<c_int>,
    sym_perm: Pointer<c_int>,
    uns_perm: Pointer<c_int>,
    colsca: Pointer<T>,
    rowsca: Pointer<T>,
    colsca_from_mumps: c_int,
    rowsca_from_mumps: c_int,
    pub rhs: Pointer<T>,
    redrhs: Pointer<T>,
    rhs_sparse: Pointer<T>,
    sol_loc: Pointer<T>,
    rhs_loc: Pointer<T>,
    irhs_sparse: Pointer<c_int>,
    irhs_ptr: Pointer<c_int>,
    isol_loc: Pointer<c_int>,
    irhs_loc: Pointer<c_int>,
    pub nrhs: c_int,
    pub lrhs: c_int,
    lredrhs: c_int,
    nz_rhs: c_int,
    lsol_loc: c_int,
    nloc_rhs: c_int,
    lrhs_loc: c_int,
    schur_mloc: c_int,
    schur_nloc: c_int,
    schur_lld: c_int,
    mblock: c_int,
    nblock: c_int,
    nprow: c_int,
    npcol: c_int,
    info: [c_int; 80],
    pub infog: [c_int; 80],
    rinfo: [T; 40],
    pub rinfog: [T; 40],
    deficiency: c_int,
    pivnul_list: Pointer<c_int>,
    mapping: Pointer<c_int>,
    size_schur: c_int,
    listvar_schur: Pointer<c_int>,
    schur: Pointer<T>,
    instance_number: c_int,
    wk_user: Pointer<T>,
    pub version_number: [c_char; 32],
    pub ooc_tmpdir: [c_char; 256],
    pub ooc_prefix: [c_char; 64],
    write_problem: [c_char; 256],
    lwk_user: c_int,
    save_dir: [c_char; 256],
    save_prefix: [c_char; 256],
    metis_options: [c_int; 40],
}

// as the C compiler lays it out
const _: () = {
    assert!(size_of::<Structure<f32>>() == 7064 && size_of::<Structure<f64>>() == 8360);
    assert!(std::mem::offset_of!(Structure<f32>, infog) == 5072 && std::mem::offset_of!(Structure<f64>, infog) == 6048);
    assert!(std::mem::offset_of!(Structure<f32>, rhs) == 4624 && std::mem::offset_of!(Structure<f64>, rhs) == 5600);
};
