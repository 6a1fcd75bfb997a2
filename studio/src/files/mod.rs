//! Files: paintings, revisions, autosave, exports, preferences.
