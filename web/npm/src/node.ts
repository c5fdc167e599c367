// temper for Node: the module beside this file, and files of the disk.
import { readFileSync, renameSync, rmSync, writeFileSync } from 'node:fs';
import { type Disk, start } from './module.ts';

const disk: Disk = {
  read(path) {
    try {
      return new Uint8Array(readFileSync(path));
    } catch (error) {
      const code = (error as { code?: string }).code;
      if (code === 'EISDIR') return 'folder';
      if (code === 'ENOENT' || code === 'ENOTDIR') return null;
      throw error;
    }
  },
  write(path, bytes) {
    const temporary = `${path}.tmp${process.pid}`;
    try {
      writeFileSync(temporary, bytes);
      renameSync(temporary, path);
    } catch (error) {
      rmSync(temporary, { force: true });
      throw error;
    }
  },
};

await start(WebAssembly.compile(readFileSync(new URL('./temper.wasm', import.meta.url))), disk);

export * from './index.ts';
