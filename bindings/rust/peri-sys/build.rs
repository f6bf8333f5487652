// SPDX-License-Identifier: MIT
//! Compiles peri_impl.c by the system's compiler, without other crates. CC and CFLAGS are heard; PERI_SOURCE is the folder of peri_impl.c
//! where it is not that of this repository. With PERI_LIB_DIR the libperi.a there is linked instead, and what PERI_LINK names (gomp, say).
use std::env;
use std::path::{Path, PathBuf};
use std::process::{exit, Command};

fn run(command: &mut Command) {
    match command.status() {
        Ok(status) if status.success() => {}
        other => {
            eprintln!("{:?}: {:?}", command, other);
            exit(1);
        }
    }
}

fn main() {
    for name in ["CC", "CFLAGS", "AR", "PERI_SOURCE", "PERI_LIB_DIR", "PERI_LINK"] {
        println!("cargo:rerun-if-env-changed={name}");
    }
    let folder = match env::var("PERI_LIB_DIR") {
        Ok(built) => PathBuf::from(built),
        Err(_) => compiled(),
    };
    println!("cargo:rustc-link-search=native={}", folder.display());
    println!("cargo:rustc-link-lib=static=peri");
    for library in env::var("PERI_LINK").unwrap_or_default().split_whitespace() {
        println!("cargo:rustc-link-lib={library}");
    }
    if env::var("CARGO_CFG_TARGET_FAMILY").unwrap_or_default() == "unix" {
        println!("cargo:rustc-link-lib=m");
    }
}

fn compiled() -> PathBuf {
    let here = PathBuf::from(env::var("CARGO_MANIFEST_DIR").unwrap());
    let source = env::var("PERI_SOURCE").map(PathBuf::from).unwrap_or_else(|_| here.join("../../.."));
    let out = PathBuf::from(env::var("OUT_DIR").unwrap());
    println!("cargo:rerun-if-changed={}", source.join("peri_impl.c").display());
    println!("cargo:rerun-if-changed={}", source.join("src").display());
    let object = out.join("peri.o");
    let flags = env::var("CFLAGS").unwrap_or_default();
    let named = env::var("CC").unwrap_or_else(|_| "cc".into());
    let mut words = named.split_whitespace(); // as in "ccache gcc"
    let mut cc = Command::new(words.next().unwrap_or("cc"));
    cc.args(words).args(["-std=c99", "-O2", "-fPIC"]).args(flags.split_whitespace());
    run(cc.arg("-c").arg(source.join("peri_impl.c")).arg("-o").arg(&object));
    let library = out.join("libperi.a");
    let _ = std::fs::remove_file(Path::new(&library));
    run(Command::new(env::var("AR").unwrap_or_else(|_| "ar".into())).arg("rcs").arg(&library).arg(&object));
    out
}
