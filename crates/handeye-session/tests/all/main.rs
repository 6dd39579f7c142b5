//! Sessions from outside: with a virtual cell, whose truth is known.

mod virtual_cell;
