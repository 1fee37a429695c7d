//! The documents: links, anchors and keys, and every command of the tutorials.

mod book;
mod markdown;
mod tutorials;
