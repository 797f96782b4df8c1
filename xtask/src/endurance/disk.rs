//! A small disk that runs full.

use std::{
    fs,
    path::{Path, PathBuf},
    process::{Command, Stdio},
};

/// A file system in memory of so many kilobytes, until it is dropped.
pub struct SmallDisk(PathBuf);

impl SmallDisk {
    /// Mounts a disk; `None` where that is not allowed.
    pub fn mounted(at: &Path, kilobytes: u32) -> Option<Self> {
        fs::create_dir_all(at).ok()?;
        let size = format!("size={kilobytes}k");
        let mut mount = Command::new("mount");
        mount.args(["-t", "tmpfs", "-o", &size, "tmpfs"]).arg(at);
        let status = mount.stderr(Stdio::null()).status().ok()?;
        status.success().then(|| Self(at.to_owned()))
    }

    /// Gives the disk another size.
    pub fn resize(&self, kilobytes: u32) -> bool {
        let size = format!("remount,size={kilobytes}k");
        let mut mount = Command::new("mount");
        mount.args(["-o", &size]).arg(&self.0);
        mount.status().is_ok_and(|status| status.success())
    }
}

impl Drop for SmallDisk {
    fn drop(&mut self) {
        let _ = Command::new("umount").arg(&self.0).status();
    }
}
