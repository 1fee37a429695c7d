//! Published numbers and limits of the bearing in space.

mod derivatives;
mod inertia;
mod other_programs;
mod published;
mod shafts;
