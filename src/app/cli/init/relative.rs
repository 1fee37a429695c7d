//! How a file is named from a folder.

use std::path::{Component, Path, PathBuf};

/// The path of a file relative to a folder, with `/` between its parts; the absolute path where they have nothing in common but
/// the root, or where one of them cannot be looked up. The folder need not exist.
pub(super) fn path_from(folder: &Path, file: &Path) -> String {
    let absolute = |path: &Path| std::path::absolute(path).map(|path| plain(&path));
    let (Ok(folder), Ok(file)) = (absolute(folder), absolute(file)) else {
        return file.display().to_string();
    };
    let common = folder.components().zip(file.components()).take_while(|(a, b)| a == b).count();
    let names = |path: &Path| {
        path.components().skip(common).map(|part| part.as_os_str().to_string_lossy().into_owned()).collect::<Vec<_>>()
    };
    let shared = folder.components().take(common).any(|part| matches!(part, Component::Normal(_)));
    if !shared {
        return file.display().to_string();
    }
    let up = vec!["..".to_owned(); names(&folder).len()];
    [up, names(&file)].concat().join("/")
}

/// Without `.` and `..`; a link to a folder is followed by nobody, so that the name stays the one that was typed.
fn plain(path: &Path) -> PathBuf {
    let mut plain = PathBuf::new();
    for part in path.components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir => {
                plain.pop();
            }
            part => plain.push(part),
        }
    }
    plain
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::path_from;

    #[test]
    fn files_are_named_from_a_folder() {
        for (folder, file, expected) in [
            (".", "a.msh", "a.msh"),
            (".", "./b/../meshes/a.msh", "meshes/a.msh"),
            ("cases", "meshes/a.msh", "../meshes/a.msh"),
            ("cases/new", "cases/a.msh", "../a.msh"),
            ("cases/new/one", "cases/a.msh", "../../a.msh"),
            ("/x/y", "/x/z/a.msh", "../z/a.msh"),
            ("/x/y", "/z/a.msh", "/z/a.msh"),
        ] {
            assert_eq!(path_from(Path::new(folder), Path::new(file)), expected, "{folder} {file}");
        }
    }
}
