"""Animations as files: MP4, WebM and GIF."""

from skinsource.export.video.video_file import ENDINGS, frames_per_s, video_file

__all__ = ["ENDINGS", "frames_per_s", "video_file"]
